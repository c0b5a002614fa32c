// two_images_to_mask FIRST SECOND MASK: what moves over the ground between two images of a flying camera.
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <redbee/detection/detector.hpp>
#include <redbee/visual/visual_homography.hpp>
#include <stdexcept>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 4) throw std::invalid_argument("usage: two_images_to_mask FIRST SECOND MASK");
  redbee::VisualHomographyEstimator estimator{redbee::VisualParameters{}};
  redbee::DetectionParameters parameters;
  parameters.learning_frames = 1;         // the first image is all there is to learn from,
  parameters.appearance.enabled = false;  // and shows no ground where the object was
  parameters.objects.confirm_s = 0;       // and there is no time for a track
  const auto detector = redbee::makeDetector(parameters);
  redbee::FrameInput frame;
  redbee::DetectorOutput output;
  for (int k = 1; k <= 2; ++k) {
    frame.colour = cv::imread(argv[k]);
    if (frame.colour.empty()) throw std::invalid_argument(argv[k] + std::string(" is no image"));
    cv::cvtColor(frame.colour, frame.grey, cv::COLOR_BGR2GRAY);
    frame.time_previous = frame.time;
    frame.time += std::chrono::milliseconds(40);
    const redbee::VisualHomography visual = estimator.step(frame.time, frame.grey, std::nullopt);
    if (visual.ground) frame.ground = visual.ground->H;
    frame.tracks = visual.tracks;
    output = detector->step(frame);
  }
  std::cout << toString(output.status) << ": " << cv::countNonZero(output.mask) << " px move\n";
  return output.status == redbee::DetectorStatus::kGood && cv::imwrite(argv[3], output.mask) ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
