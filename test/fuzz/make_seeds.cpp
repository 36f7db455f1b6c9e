#include "fuzz/core_input.h"
#include "fuzz/targets.h"
#include "support/scenes.h"

#include <pcl/io/pcd_io.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace grasp_affordances::fuzz
{
namespace
{

namespace fs = std::filesystem;

/// Writes files TARGET/NAME in a folder.
class Seeds
{
public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder))
  {
    for (const Target& target : kTargets) {
      fs::create_directories(folder_ / target.name);
    }
  }

  std::string path(const std::string& target, const std::string& name) const { return folder_ / target / name; }

  void write(const std::string& target, const std::string& name, const std::string& bytes) const
  {
    std::ofstream(path(target, name), std::ios::binary) << bytes;
  }

private:
  fs::path folder_;
};

std::string contentOf(const fs::path& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Every n-th pixel of a window in an image, as an image of its own whose middle is where the camera looks.
Cloud crop(const Cloud& cloud, std::size_t middle, std::uint32_t width, std::uint32_t height, std::uint32_t every)
{
  const auto begin = [every](std::size_t at, std::uint32_t size, std::uint32_t limit) {
    const std::size_t half = std::size_t{size} * every / 2, last = limit - std::size_t{size} * every;
    return std::min(last, at > half ? at - half : 0);
  };
  const std::size_t left = begin(middle % cloud.width, width, cloud.width);
  const std::size_t top = begin(middle / cloud.width, height, cloud.height);
  Cloud small;
  small.reset(width, height);
  const double focal_length = cloud.intrinsics->fx / every;
  small.intrinsics = PinholeIntrinsics{focal_length, focal_length, (width - 1) / 2.0, (height - 1) / 2.0};
  for (std::size_t i = 0; i < small.size(); ++i) {
    const std::size_t from = (top + i / width * every) * cloud.width + left + i % width * every;
    small.set(i, cloud.x[from], cloud.y[from], cloud.z[from]);
  }
  return small;
}

/// The pixel in the middle of those of the first affordance that shows; of the image where none does.
std::size_t middleOfAffordance(const test::LabelledFrame& frame)
{
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    if (frame.labels[i] == 1 && frame.cloud.measured(i)) {
      pixels.push_back(i);
    }
  }
  return pixels.empty() ? frame.labels.size() / 2 + frame.cloud.width / 2 : pixels[pixels.size() / 2];
}

void writeCoreSeeds(const Seeds& seeds)
{
  for (const char* scene : {"table", "household1", "mugs"}) {
    const test::LabelledFrame frame = test::captureScene(scene, 1);
    const std::size_t middle = middleOfAffordance(frame);
    const Cloud near = crop(frame.cloud, middle, 40, 38, 1), wide = crop(frame.cloud, middle, 40, 38, 2);
    const Cloud narrow = crop(frame.cloud, middle, 20, 38, 2);
    for (unsigned preset = 0; preset < 2; ++preset) {
      for (unsigned estimator = 0; estimator < 3; ++estimator) {
        const SeedConfig config{preset, estimator, estimator % 2, preset, 3};
        const std::string name = std::string(scene) + "_" + std::to_string(preset) + std::to_string(estimator);
        seeds.write("core", name + "_near", encodeDepths(config, {near}, Intrinsics::right));
        seeds.write("core", name + "_wide", encodeDepths(config, {wide}, Intrinsics::none));
        seeds.write("core", name + "_views", encodeDepths(config, {narrow, narrow}, Intrinsics::right));
        Cloud unorganized = crop(frame.cloud, middle, 20, 40, 4);
        unorganized.width = 160;  // a byte is written
        unorganized.height = 5;
        seeds.write("core", name + "_loose", encodeCoordinates(config, unorganized));
      }
    }
  }
  for (unsigned shape = 0; shape < kShapes; ++shape) {
    for (unsigned scale = 0; scale < kScales; ++scale) {
      const SeedConfig config{shape % 2, (shape + scale) % 3, scale % 2, 0, 3};
      seeds.write("core", "shape_" + std::to_string(shape) + std::to_string(scale), encodeShape(config, shape, scale));
    }
  }
}

sensor_msgs::PointCloud2 makeMessage(const Cloud& cloud, bool colored)
{
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = "camera";
  message.width = cloud.width;
  message.height = cloud.height;
  message.point_step = colored ? 32 : 12;
  message.row_step = message.point_step * message.width;
  for (const char* name : {"x", "y", "z", "rgb"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = 4 * static_cast<std::uint32_t>(message.fields.size());
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    if (colored || field.offset < 12) {
      message.fields.push_back(field);
    }
  }
  message.data.resize(std::size_t{message.row_step} * message.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float values[] = {cloud.x[i], cloud.y[i], cloud.z[i]};
    std::memcpy(&message.data[i * message.point_step], values, sizeof(values));
  }
  return message;
}

void writePointCloud2Seeds(const Seeds& seeds, const Cloud& cloud)
{
  for (const bool colored : {false, true}) {
    for (const bool real : {false, true}) {
      const sensor_msgs::PointCloud2 message = makeMessage(cloud, colored);
      ByteWriter output;
      output.put(std::uint16_t{0}).byte(message.width).byte(message.height).byte(message.point_step).byte(0).byte(1);
      output.byte(static_cast<unsigned>(message.fields.size()));
      for (std::size_t i = 0; i < message.fields.size(); ++i) {
        const unsigned datatype = real ? sensor_msgs::PointField::FLOAT64 : sensor_msgs::PointField::FLOAT32;
        output.byte(static_cast<unsigned>(i)).byte(datatype).byte(message.fields[i].offset).byte(1);
      }
      output.byte(0);
      seeds.write("point_cloud2", std::string(colored ? "colored" : "plain") + (real ? "_double" : ""),
                  output.bytes() + std::string(message.data.begin(), message.data.end()));
    }
  }
}

void writePcdSeeds(const Seeds& seeds, const Cloud& cloud)
{
  pcl::PointCloud<pcl::PointXYZRGB> points;
  points.width = cloud.width;
  points.height = cloud.height;
  points.is_dense = false;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    pcl::PointXYZRGB point;
    point.getVector3fMap() = cloud.point(i);
    points.push_back(point);
  }
  points.width = cloud.width;
  points.height = cloud.height;
  points.sensor_origin_ << 0.1F, 0.2F, 0.3F, 0.0F;
  pcl::io::savePCDFileASCII(seeds.path("pcd", "ascii"), points);
  pcl::io::savePCDFileBinary(seeds.path("pcd", "binary"), points);
  pcl::io::savePCDFileBinaryCompressed(seeds.path("pcd", "compressed"), points);
  seeds.write("pcd", "small",
              "VERSION .7\nFIELDS x y z _ label\nSIZE 4 8 4 1 2\nTYPE F F F U U\nCOUNT 1 1 1 2 1\nWIDTH 2\nHEIGHT 1\n"
              "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3 0 0 7\nnan nan nan 0 0 65535\n");
  seeds.write("pcd", "old", "COLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n");
}

/// Bags keep 4 KiB for the header of the file, which holds a hundred bytes: takes the rest of it out.
std::string withoutPadding(std::string bag)
{
  const std::size_t start = std::string("#ROSBAG V2.0\n").size();
  const auto at = [&bag](std::size_t place, auto value) {
    std::memcpy(&value, &bag[place], sizeof(value));
    return value;
  };
  const auto put = [&bag](std::size_t place, auto value) { std::memcpy(&bag[place], &value, sizeof(value)); };
  const auto header = at(start, std::uint32_t{0});
  const auto padding = at(start + 4 + header, std::uint32_t{0});
  put(start + 4 + header, std::uint32_t{0});
  bag.erase(start + 4 + header + 4, padding);
  for (const std::string key : {"index_pos=", "chunk_pos="}) {
    for (std::size_t found = bag.find(key); found != std::string::npos; found = bag.find(key, found + 1)) {
      put(found + key.size(), at(found + key.size(), std::uint64_t{0}) - padding);
    }
  }
  return bag;
}

template <typename Message>
boost::shared_ptr<ros::M_string> connectionHeader(const Message& message)
{
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = "-";
  return header;
}

void writeBagSeeds(const Seeds& seeds, const Cloud& cloud)
{
  const std::pair<const char*, rosbag::CompressionType> kCompressions[] = {{"plain", rosbag::compression::Uncompressed},
                                                                           {"bz2", rosbag::compression::BZ2},
                                                                           {"lz4", rosbag::compression::LZ4}};
  for (const auto& [name, compression] : kCompressions) {
    const std::string path = seeds.path("bag", name);
    const sensor_msgs::PointCloud2 message = makeMessage(cloud, false);
    const sensor_msgs::CameraInfo camera;
    const auto of_clouds = connectionHeader(message), of_cameras = connectionHeader(camera);
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(600);
    for (std::uint32_t i = 1; i <= 4; ++i) {
      bag.write("/points", ros::Time(i), message, of_clouds);
      if (i == 2) {
        bag.write("/camera_info", ros::Time(i), camera, of_cameras);
      }
    }
    bag.close();
    const std::string bytes = contentOf(path);
    seeds.write("bag", name, withoutPadding(bytes));
  }
}

void writeTextSeeds(const Seeds& seeds)
{
  const fs::path config = fs::path(GRASP_AFFORDANCES_SOURCE_DIR) / "config";
  for (const char* name : {"localizer.yaml", "paper.yaml", "hands/franka.yaml"}) {
    seeds.write("config_yaml", fs::path(name).filename(), contentOf(config / name));
  }
  seeds.write("config_yaml", "small",
              "preset: paper\nhand: {capture_radius: 0.05}\nshell/recenter: true\nthreads: 1\n");
  seeds.write("config_yaml", "anchors", "hand: &h {palm_width: !!float 0.1}\n<<: *h\n? sampling/seed\n: 0x10\n...\n");
  seeds.write("labels_json", "small",
              R"({"capture_radius": 0.048, "scenes": {"a": {"affordances": [[20], [30, 31]], "ignore": [50]}}})");
  seeds.write("labels_json", "several",
              R"({"capture_radius": 5e-2, "scenes": {"a": {"affordances": [], "ignore": []}, "b\u0062": )"
              R"({"affordances": [[0]], "ignore": [4294967295, -1, 1.5]}}, "more": [null, true, {}]})");
}

void writeSeeds(const fs::path& folder)
{
  const Seeds seeds(folder);
  const Cloud cloud = crop(test::captureScene("table", 1).cloud, 320 + 240 * 640, 6, 4, 8);
  writeCoreSeeds(seeds);
  writePointCloud2Seeds(seeds, cloud);
  writePcdSeeds(seeds, cloud);
  writeBagSeeds(seeds, cloud);
  writeTextSeeds(seeds);
}

}  // namespace
}  // namespace grasp_affordances::fuzz

/// make_fuzz_seeds FOLDER: inputs for each target to start from, out of simulated clouds.
int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "make_fuzz_seeds FOLDER\n";
    return 2;
  }
  try {
    grasp_affordances::fuzz::writeSeeds(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "make_fuzz_seeds: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
