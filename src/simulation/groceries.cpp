#include "simulation/groceries.h"

#include "simulation/placement.h"

namespace grasp_affordances
{

Scene randomTin(CounterRandom& random)
{
  const double height = random.uniform(0.08, 0.115);
  Scene scene;
  scene.beginObject("tin");
  scene.add(Cylinder{random.uniform(0.033, 0.0375), height}, at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomDrinkBottle(CounterRandom& random)
{
  const double radius = random.uniform(0.03, 0.044);
  const double body = random.uniform(0.12, 0.16);
  const double neck = body + random.uniform(0.045, 0.065);
  const double cap = random.uniform(0.014, 0.016);
  Scene scene;
  scene.beginObject("drink bottle");
  scene.add(Revolution{{{0.0, 0.92 * radius},
                        {0.008, radius},
                        {body, radius},
                        {neck, 0.013},
                        {neck + 0.008, 0.013},
                        {neck + 0.009, cap},
                        {neck + 0.024, cap}}},
            Eigen::Isometry3d::Identity());
  return scene;
}

Scene randomMilkCarton(CounterRandom& random)
{
  const double width = random.uniform(0.052, 0.075);
  const double height = random.uniform(0.15, 0.21);
  Scene scene;
  scene.beginObject("carton");
  scene.add(RoundedBox{{width, width, height}, 0.003}, at(0.0, 0.0, 0.5 * height));
  scene.add(Cylinder{0.014, 0.012}, at(0.0, 0.0, height + 0.006));
  return scene;
}

Scene randomPackage(CounterRandom& random)
{
  const double height = random.uniform(0.11, 0.17);
  Scene scene;
  scene.beginObject("package");
  scene.add(RoundedBox{{random.uniform(0.03, 0.05), random.uniform(0.06, 0.1), height}, 0.002},
            at(0.0, 0.0, 0.5 * height));
  return scene;
}

Scene randomOrange(CounterRandom& random)
{
  const double radius = random.uniform(0.033, 0.043);
  Scene scene;
  scene.beginObject("orange");
  scene.add(Sphere{radius}, at(0.0, 0.0, radius));
  return scene;
}

Scene randomLemon(CounterRandom& random)
{
  const double radius = random.uniform(0.028, 0.031);
  Scene scene;
  scene.beginObject("lemon");
  scene.add(Ellipsoid{{random.uniform(0.032, 0.036), radius, radius}}, at(0.0, 0.0, radius));
  return scene;
}

}  // namespace grasp_affordances
