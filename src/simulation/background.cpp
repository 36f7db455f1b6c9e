#include "simulation/background.h"

#include "simulation/arrangement.h"
#include "simulation/counter_random.h"
#include "simulation/furniture.h"
#include "simulation/placement.h"
#include "simulation/things.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <variant>

namespace grasp_affordances
{
namespace
{

/// Copies objects with their parts and chains. @param keeps whether an object of a role is copied
/// @param surface_of surface of the copy of a part
template <typename Keeps, typename SurfaceOf>
void copyObjects(const Scene& from, Keeps&& keeps, SurfaceOf&& surface_of, Scene& to)
{
  std::vector<std::size_t> new_index(from.parts().size());
  for (std::size_t object = 0; object < from.objects().size(); ++object) {
    if (!keeps(from.roles()[object]))
      continue;
    to.beginObject(from.objects()[object], from.roles()[object]);
    for (std::size_t i = 0; i < from.parts().size(); ++i) {
      const Part& part = from.parts()[i];
      if (part.object == object)
        new_index[i] = to.add(part.shape, part.T_scene_shape, surface_of(part));
    }
  }
  for (std::vector<std::size_t> chain : from.chains()) {
    if (!keeps(from.roles()[from.parts()[chain.front()].object]))
      continue;
    for (std::size_t& part : chain)
      part = new_index[part];
    to.join(chain);
  }
}

void addBlock(Scene& scene, const Eigen::Isometry3d& T_scene_frame, const Eigen::AlignedBox3d& block, Surface surface)
{
  scene.add(Box{block.sizes()}, T_scene_frame * Eigen::Translation3d(block.center()), surface);
}

/// What is left of a table or a floor: it ends shortly beside the things. A table does not grow.
void addCutSupport(const Scene& scene, const Part& support, CounterRandom& random, Scene& cut)
{
  constexpr double kLeastEdge = 0.03, kWidestEdge = 0.1, kThickness = 0.03;  // m
  const Box* table = std::get_if<Box>(&support.shape);
  const double half_height = table == nullptr ? 0.0 : 0.5 * table->size.z();
  const Eigen::Isometry3d T_scene_top = support.T_scene_shape * at(0.0, 0.0, half_height);
  Eigen::AlignedBox3d block = boundsOfThings(scene, T_scene_top.inverse());
  if (block.isEmpty()) {
    cut.add(support.shape, support.T_scene_shape, support.surface);
    return;
  }
  for (const int axis : {0, 1}) {
    block.min()[axis] -= random.uniform(kLeastEdge, kWidestEdge);
    block.max()[axis] += random.uniform(kLeastEdge, kWidestEdge);
    if (table != nullptr) {
      block.min()[axis] = std::max(block.min()[axis], -0.5 * table->size[axis]);
      block.max()[axis] = std::min(block.max()[axis], 0.5 * table->size[axis]);
    }
  }
  block.min().z() = -kThickness;
  block.max().z() = 0.0;
  addBlock(cut, T_scene_top, block, support.surface);
}

/// Boards in place of a wall, behind the things that hang on it.
void addBoards(const Scene& scene, const Part& wall, Scene& cut)
{
  constexpr double kTouching = 0.02, kStanding = 0.02, kEdge = 0.05, kThickness = 0.02;  // m
  const Eigen::Isometry3d T_wall_scene = wall.T_scene_shape.inverse();
  for (std::size_t object = 0; object < scene.objects().size(); ++object) {
    if (scene.roles()[object] != Role::thing)
      continue;
    Eigen::AlignedBox3d board = boundsOf(scene, object, T_wall_scene);
    const bool stands = boundsOf(scene, object, Eigen::Isometry3d::Identity()).min().z() < kStanding;
    if (stands || board.min().z() > kTouching)
      continue;
    board.min() -= Eigen::Vector3d::Constant(kEdge);
    board.max() += Eigen::Vector3d::Constant(kEdge);
    board.min().z() = -kThickness;
    board.max().z() = 0.0;
    cut.beginObject("board", Role::support);
    addBlock(cut, wall.T_scene_shape, board, wall.surface);
  }
}

/// The things with what they stand and hang on, and nothing else.
Scene withoutSurroundings(const Scene& scene, CounterRandom& random)
{
  Scene cut;
  for (const Part& part : scene.parts()) {
    const Role role = scene.roles()[part.object];
    if (role == Role::support) {
      cut.beginObject("table", Role::support);
      addCutSupport(scene, part, random, cut);
    } else if (role == Role::wall) {
      addBoards(scene, part, cut);
    }
  }
  copyObjects(
      scene, isThing, [](const Part& part) { return part.surface; }, cut);
  return cut;
}

/// Four walls at a distance from a point, turned about the vertical by `yaw`, and a floor.
void addHall(Scene& scene, const Eigen::Vector3d& middle, double yaw, double half_width, double floor)
{
  scene.beginObject("floor", Role::background);
  scene.add(HalfSpace{}, at(0.0, 0.0, floor));
  scene.beginObject("walls", Role::background);
  for (const double side : {0.0, 90.0, 180.0, 270.0}) {
    const Eigen::Isometry3d T_scene_hall = at(middle.x(), middle.y(), 0.0);
    const Eigen::Isometry3d T_wall =
        at(0.0, half_width, 0.0) * turned(90.0 * kDegree, Eigen::Vector3d::UnitX());  // its z towards the middle
    scene.add(HalfSpace{}, T_scene_hall * turned(yaw + kDegree * side, Eigen::Vector3d::UnitZ()) * T_wall);
  }
}

void addFarHall(View& view, CounterRandom& random)
{
  const Eigen::Vector3d middle = middleOfThings(view.scene);
  const double yaw = kDegree * random.uniform(-45.0, 45.0);
  const double half_width = random.uniform(4.2, 4.6);
  addHall(view.scene, middle, yaw, half_width, middle.z() - random.uniform(3.4, 3.8));
}

/// Furniture all around the camera, so that it is seen from aside as well.
void addRoom(View& view, CounterRandom& random)
{
  constexpr int kPieces = 14;
  constexpr double kTableHeight = 0.72, kCameraHeight = 1.9, kClear = 1.3;  // m
  const Eigen::Vector3d middle = middleOfThings(view.scene);
  const Eigen::Vector3d camera = view.T_scene_camera.translation();
  const double floor = std::min(-kTableHeight, camera.z() - kCameraHeight);
  addHall(view.scene, camera, kDegree * random.uniform(-45.0, 45.0), random.uniform(4.1, 4.6), floor);
  const double first = random.uniform(0.0, 1.0);
  for (int piece = 0; piece < kPieces; ++piece) {
    const Scene furniture = randomFurniture(random);
    const double azimuth = 2.0 * kPi * (piece + first + random.uniform(-0.3, 0.3)) / kPieces;
    const double distance = random.uniform(2.2, 3.4);
    const Eigen::Vector2d place = camera.head<2>() + distance * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    const double yaw = random.uniform(0.0, 2.0 * kPi);
    if ((place - middle.head<2>()).norm() > kClear)
      append(furniture, at(0.0, 0.0, floor) * upright(place.x(), place.y(), yaw), view.scene);
  }
}

bool anyOf(const Scene& scene, Role role)
{
  return std::count(scene.roles().begin(), scene.roles().end(), role) > 0;
}

/// A screen behind the things, and a suitcase on either side. In the frame of the camera's azimuth: x to the right,
/// y away from it.
void addDarkNeighbors(View& view, CounterRandom& random)
{
  const Eigen::Vector3d forward = view.T_scene_camera.linear().col(2);
  const double yaw = std::atan2(forward.y(), forward.x()) - 0.5 * kPi;
  const Eigen::Isometry3d T_scene_view = turned(yaw, Eigen::Vector3d::UnitZ());
  const Eigen::AlignedBox3d things = boundsOfThings(view.scene, T_scene_view.inverse());
  if (things.isEmpty())
    return;
  const auto gap = [&] { return random.uniform(0.03, 0.06); };
  if (!anyOf(view.scene, Role::wall)) {
    const double half_width = 0.5 * random.uniform(0.6, 1.0) * things.sizes().x();
    const double spare = 0.5 * things.sizes().x() - half_width;
    const double x = things.center().x() + random.uniform(-spare, spare);
    const double y = things.max().y() + gap();
    view.scene.beginObject("screen", Role::support);
    addBlock(
        view.scene, T_scene_view,
        {Eigen::Vector3d(x - half_width, y, 0.0), Eigen::Vector3d(x + half_width, y + 0.03, random.uniform(0.25, 0.4))},
        Surface::absorbing);
  }
  for (const double side : {-1.0, 1.0}) {
    const double depth = random.uniform(0.5, 0.9) * things.sizes().y();
    const double y = things.min().y() + random.uniform(0.0, things.sizes().y() - depth);
    const double near = (side < 0.0 ? things.min().x() : things.max().x()) + side * gap();
    const double far = near + side * random.uniform(0.12, 0.16);
    view.scene.beginObject("dark suitcase", Role::support);
    addBlock(view.scene, T_scene_view,
             {Eigen::Vector3d(std::min(near, far), y, 0.0),
              Eigen::Vector3d(std::max(near, far), y + depth, random.uniform(0.24, 0.32))},
             random.coin() ? Surface::absorbing : Surface::dark);
  }
}

/// Walls and fronts swallow the light; where there is no front, so do things that stand behind and beside.
View darkened(const View& view, CounterRandom& random)
{
  const auto surface = [&](const Part& part) {
    const Role role = view.scene.roles()[part.object];
    return role == Role::wall || role == Role::front ? Surface::absorbing : part.surface;
  };
  View dark{Scene(), view.T_scene_camera};
  copyObjects(
      view.scene, [](Role) { return true; }, surface, dark.scene);
  if (!anyOf(view.scene, Role::front))
    addDarkNeighbors(dark, random);
  return dark;
}

}  // namespace

const std::vector<std::string>& backgroundNames()
{
  static const std::vector<std::string> names = {"walls", "open", "far", "room", "dark"};
  return names;
}

Background backgroundFromName(const std::string& name)
{
  const std::vector<std::string>& names = backgroundNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::invalid_argument("unknown background '" + name + "'; it must be one of walls open far room dark");
  return static_cast<Background>(found - names.begin());
}

View withBackground(const View& view, Background background, std::uint64_t seed)
{
  if (background == Background::walls)
    return view;
  CounterRandom random(seed, RandomStream::background);
  if (background == Background::dark)
    return darkened(view, random);
  View cut{withoutSurroundings(view.scene, random), view.T_scene_camera};
  if (background == Background::far)
    addFarHall(cut, random);
  else if (background == Background::room)
    addRoom(cut, random);
  return cut;
}

}  // namespace grasp_affordances
