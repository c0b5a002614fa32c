#include "redbee/simulation/props.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/angle.hpp"

namespace redbee::simulation {
namespace {

const Eigen::Vector3d kLeafGreen(0.5, 1.0, 0.65), kAutumn(0.35, 0.75, 1.25), kBark(0.7, 0.9, 1.1),
    kSand(0.75, 0.98, 1.12), kWall(0.85, 0.97, 1.08), kRedBrick(0.6, 0.8, 1.35), kSea(1.4, 1.05, 0.7),
    kNeutral(1, 1, 1);

Eigen::Vector2d heading(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

}  // namespace

Materials::Materials(Draw& draw) {
  const auto material = [&](TextureKind kind, double texel_m, double mean, double contrast,
                            const Eigen::Vector3d& bgr) {
    return Material{kind, draw.seed(), texel_m, mean, contrast, bgr};
  };
  const auto tinted = [&] {
    return Eigen::Vector3d(draw.uniform(0.5, 1.6), draw.uniform(0.7, 1.2), draw.uniform(0.5, 1.6));
  };
  grass = material(TextureKind::kGrass, 0.015, draw.uniform(85, 125), draw.uniform(12, 28), kLeafGreen);
  sand = material(TextureKind::kGrass, 0.02, draw.uniform(140, 180), draw.uniform(8, 18), kSand);
  asphalt = material(TextureKind::kGrass, 0.01, draw.uniform(70, 110), draw.uniform(6, 14), kNeutral);
  gravel = material(TextureKind::kGrass, 0.012, draw.uniform(120, 165), draw.uniform(10, 22), kSand);
  bark = material(TextureKind::kGrass, 0.01, draw.uniform(45, 80), 14, kBark);
  metal = material(TextureKind::kGrass, 0.01, draw.uniform(35, 150), 5, kNeutral);
  wood = material(TextureKind::kGrass, 0.01, draw.uniform(80, 130), 14, kRedBrick);
  roof = material(TextureKind::kFacade, 0.008, draw.uniform(60, 100), 18, kBark);
  rock = material(TextureKind::kWater, 0.008, draw.uniform(100, 150), 20, kNeutral);
  wheel = material(TextureKind::kGrass, 0.01, 30, 6, kNeutral);
  glass = material(TextureKind::kWater, 0.02, draw.uniform(35, 70), 8, kSea);
  skin = material(TextureKind::kGrass, 0.01, draw.uniform(90, 160), 6, kRedBrick);
  water = material(TextureKind::kWater, 0.02, draw.uniform(70, 110), draw.uniform(14, 28), kSea);
  const bool is_autumn = draw.chance(0.3);
  for (int i = 0; i < 3; ++i) {
    leaves.push_back(material(TextureKind::kGrass, 0.02, draw.uniform(55, 105), draw.uniform(20, 34),
                              is_autumn && draw.chance(0.7) ? kAutumn : kLeafGreen));
    walls.push_back(material(TextureKind::kFacade, 0.015, draw.uniform(100, 170), draw.uniform(20, 38),
                             draw.chance(0.5) ? kRedBrick : kWall));
    paints.push_back(
        material(TextureKind::kWater, 0.02, draw.uniform(40, 200), draw.uniform(3, 10), tinted()));
  }
  for (int i = 0; i < 7; ++i) {
    clothes.push_back(
        material(TextureKind::kBody, 0.008, draw.uniform(35, 200), draw.uniform(6, 25), tinted()));
  }
}

const Material& Props::oneOf(const std::vector<Material>& materials) {
  return materials[static_cast<size_t>(draw_.integer(0, static_cast<int>(materials.size()) - 1))];
}

Patch& Props::addRound(const Eigen::Vector2d& at, double bottom_m, double width_m, double height_m,
                       const Material& material) {
  Patch patch = uprightPatch(PatchKind::kFront, at.x(), at.y(), 0, width_m, height_m, material);
  patch.centre.z() += bottom_m;
  patch.is_round = true;
  scene_.patches.push_back(patch);
  return scene_.patches.back();
}

void Props::addCrown(const Eigen::Vector3d& centre, double width_m, double height_m, const Material& leaves) {
  Patch& crown = addRound(centre.head<2>(), 0, width_m, height_m, leaves);
  crown.centre = centre;
  crown.shape = PatchShape::kFoliage;
  if (wind_m_ > 0) {
    crown.sway =
        Sway{Eigen::Vector3d(draw_.uniform(-1, 1), draw_.uniform(-1, 1), draw_.uniform(-0.4, 0.4)) * wind_m_,
             draw_.uniform(0.3, 1.1), draw_.uniform(0, kTurn)};
  }
}

void Props::addTree(const Eigen::Vector2d& at) {
  if (!hasRoomFor(10)) return;
  const double height_m = draw_.uniform(3, 8), trunk_m = height_m * draw_.uniform(0.25, 0.45),
               radius_m = height_m * draw_.uniform(0.22, 0.38);
  const Material& leaves = oneOf(materials_.leaves);
  addRound(at, 0, height_m * draw_.uniform(0.03, 0.06), trunk_m + 0.4 * radius_m, materials_.bark);
  const int crowns = draw_.integer(5, 8);
  for (int i = 0; i < crowns; ++i) {
    const double angle = draw_.uniform(0, kTurn), out_m = radius_m * draw_.uniform(0.1, 0.75);
    const Eigen::Vector2d beside = at + out_m * heading(angle);
    const double width_m = radius_m * draw_.uniform(0.8, 1.5);
    addCrown({beside.x(), beside.y(), trunk_m + draw_.uniform(0.1, 1) * (height_m - trunk_m)}, width_m,
             width_m * draw_.uniform(0.6, 1), leaves);
  }
}

void Props::addConifer(const Eigen::Vector2d& at) {
  if (!hasRoomFor(6)) return;
  const double height_m = draw_.uniform(4, 9);
  const Material& leaves = oneOf(materials_.leaves);
  addRound(at, 0, 0.2, height_m * 0.3, materials_.bark);
  for (int i = 0; i < 5; ++i) {
    const double up = 0.2 + 0.17 * i;
    addCrown({at.x(), at.y(), up * height_m}, height_m * 0.45 * (1.05 - up), height_m * 0.28, leaves);
  }
}

void Props::addBush(const Eigen::Vector2d& at) {
  if (!hasRoomFor(3)) return;
  const double size_m = draw_.uniform(0.6, 1.8);
  const Material& leaves = oneOf(materials_.leaves);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d beside = at + 0.35 * size_m * heading(draw_.uniform(0, kTurn));
    addCrown({beside.x(), beside.y(), 0.35 * size_m}, size_m * draw_.uniform(0.6, 1), 0.7 * size_m, leaves);
  }
}

void Props::addLampPost(const Eigen::Vector2d& at) {
  if (!hasRoomFor(2)) return;
  const double height_m = draw_.uniform(2.5, 6);
  addRound(at, 0, draw_.uniform(0.06, 0.16), height_m, materials_.metal);
  addRound(at, height_m - 0.1, 0.45, 0.3, materials_.metal).shape = PatchShape::kEllipse;
}

void Props::addSign(const Eigen::Vector2d& at, double yaw_rad) {
  if (!hasRoomFor(2)) return;
  addRound(at, 0, 0.07, 1.8, materials_.metal);
  Patch plate = uprightPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad, draw_.uniform(0.5, 1.2),
                             draw_.uniform(0.4, 0.8), oneOf(materials_.clothes));
  plate.centre.z() += 1.7;
  scene_.patches.push_back(plate);
}

void Props::addBench(const Eigen::Vector2d& at, double yaw_rad) {
  if (!hasRoomFor(4)) return;
  scene_.patches.push_back(
      lyingPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad, 1.6, 0.45, 0.45, materials_.wood));
  Patch back =
      uprightPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad + kTurn / 4, 1.6, 0.4, materials_.wood);
  back.centre.z() += 0.5;
  scene_.patches.push_back(back);
  for (const double side : {-0.7, 0.7})
    addRound(at + side * heading(yaw_rad), 0, 0.08, 0.45, materials_.metal);
}

void Props::addRock(const Eigen::Vector2d& at) {
  if (!hasRoomFor(1)) return;
  const double width_m = draw_.uniform(0.2, 1.2), height_m = width_m * draw_.uniform(0.5, 0.8);
  addRound(at, -0.4 * height_m, width_m, height_m, materials_.rock).shape = PatchShape::kEllipse;
}

void Props::addFence(const Eigen::Vector2d& from, double yaw_rad, double length_m) {
  const double spacing_m = draw_.uniform(1, 2.5);
  for (double along_m = 0; along_m < length_m && hasRoomFor(3); along_m += spacing_m)
    addRound(from + along_m * heading(yaw_rad), 0, 0.09, 1.1, materials_.wood);
  const Eigen::Vector2d middle = from + length_m / 2 * heading(yaw_rad);
  for (const double up_m : {0.5, 0.9}) {
    if (!hasRoomFor(1)) return;
    Patch rail = uprightPatch(PatchKind::kFront, middle.x(), middle.y(), yaw_rad + kTurn / 4, length_m, 0.09,
                              materials_.wood);
    rail.centre.z() += up_m;
    scene_.patches.push_back(rail);
  }
}

void Props::addHouse(const Eigen::Vector2d& at, double yaw_rad) {
  addBox(at, yaw_rad, {draw_.uniform(6, 14), draw_.uniform(5, 9), draw_.uniform(3, 8)}, 0,
         oneOf(materials_.walls), materials_.roof);
}

void Props::addStrip(const Eigen::Vector2d& middle, double yaw_rad, double length_m, double breadth_m,
                     const Material& material) {
  if (!hasRoomFor(1)) return;
  // Later ones lie on top.
  const double lift_m = 0.004 + 0.0005 * static_cast<double>(scene_.patches.size() % 60);
  scene_.patches.push_back(
      lyingPatch(PatchKind::kFront, middle.x(), middle.y(), yaw_rad, length_m, breadth_m, lift_m, material));
}

void Props::addBox(const Eigen::Vector2d& at, double yaw_rad, const Eigen::Vector3d& size_m, double bottom_m,
                   const Material& sides, const Material& top) {
  if (!hasRoomFor(5)) return;
  for (int side = 0; side < 4; ++side) {
    const double out_rad = yaw_rad + side * kTurn / 4;
    const bool is_end = side % 2 == 0;
    const Eigen::Vector2d middle = at + (is_end ? size_m.x() : size_m.y()) / 2 * heading(out_rad);
    Patch patch = uprightPatch(PatchKind::kFront, middle.x(), middle.y(), out_rad,
                               is_end ? size_m.y() : size_m.x(), size_m.z(), sides);
    patch.centre.z() += bottom_m;
    scene_.patches.push_back(patch);
  }
  scene_.patches.push_back(lyingPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad, size_m.x(), size_m.y(),
                                      bottom_m + size_m.z(), top));
}

}  // namespace redbee::simulation
