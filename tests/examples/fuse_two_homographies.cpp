// fuse_two_homographies: the ground's homography between two frames, as an IMU predicts it and as vision
// measures it, fused by their covariances.
#include <cstdio>
#include <redbee/fusion/homography_fusion.hpp>
#include <redbee/fusion/transfer_sigma.hpp>

int main() {
  const int width = 640, height = 480;
  const redbee::CameraTime first(redbee::Duration(0)), second(redbee::Duration(40'000));
  // Covariances are of the scaled homography; one of its units is half of the image's width.
  redbee::InertialInput inertial{first, Eigen::Matrix3d::Identity(), 4e-6 * redbee::Matrix8d::Identity()};
  inertial.H(0, 2) = 4;  // px, to the right
  redbee::VisualInput visual{first, inertial.H, 1e-7 * redbee::Matrix8d::Identity(), 150, 50};
  visual.H(0, 2) = 5;

  const redbee::FusionParameters parameters;
  redbee::HomographyFusion fusion(width, height, parameters);
  fusion.step(first, std::nullopt, std::nullopt);
  const redbee::FusedHomography fused = fusion.step(second, inertial, visual);

  const auto print = [&](const char* name, const Eigen::Matrix3d& H, const redbee::Matrix8d& covariance) {
    const Eigen::Matrix3d scaled = redbee::ImageScaling(width, height).scale(H);
    std::printf("%-10s %8.4f px, sigma %7.4f px\n", name, H(0, 2),
                redbee::transferSigma(scaled, covariance, width, height));
  };
  print("inertial", inertial.H, inertial.covariance);
  print("visual", visual.H, redbee::measurementCovariance(visual, parameters));  // with its outliers' doubt
  print(toString(fused.source), fused.H_step, fused.covariance_step);
}
