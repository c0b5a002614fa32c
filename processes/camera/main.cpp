#include "processes/camera/gstreamer/gstreamer_source.hpp"
#include "processes/camera/node.hpp"
#include "processes/run_process.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/node/host_clock.hpp"

int main(int argc, char** argv) {
  using namespace redbee;  // NOLINT: a program of one page
  return runProcess(argc, argv, kCamera,
                    [](Bus& bus, const Configuration& configuration) -> std::unique_ptr<Node> {
                      const std::string& pipeline = configuration.capture.pipeline;
                      if (pipeline.empty()) {
                        throw UserError(
                            "capture.pipeline: is not set in this configuration; set it to a GStreamer "
                            "pipeline with an appsink");
                      }
                      return std::make_unique<CameraNode>(
                          bus, configuration, std::make_unique<GstreamerSource>(pipeline), hostNanoseconds);
                    });
}
