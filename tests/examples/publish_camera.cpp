// publish_camera URL IMAGE...: publishes images as CAMERA on LCM, 24 a second, as a camera's driver does.
// With udpm://239.255.76.67:7667?ttl=0 the processes on this host receive them.
#include <chrono>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <redbee/bus/bus.hpp>
#include <redbee/bus/image.hpp>
#include <stdexcept>
#include <string>
#include <thread>

int main(int argc, char** argv) try {
  if (argc < 3) throw std::invalid_argument("usage: publish_camera URL IMAGE...");
  const auto bus = redbee::makeLcmBus(argv[1]);
  auto next = std::chrono::system_clock::now();
  for (int k = 2; k < argc; ++k) {
    const cv::Mat image = cv::imread(argv[k]);
    if (image.empty()) throw std::invalid_argument(argv[k] + std::string(" is no image"));
    std::this_thread::sleep_until(next);
    const auto exposure = std::chrono::duration_cast<std::chrono::microseconds>(next.time_since_epoch());
    bus->publish("CAMERA", redbee::jpegMessage(exposure.count(), image, 90));
    next += std::chrono::microseconds(1'000'000 / 24);
  }
  std::cout << argc - 2 << " images published\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
