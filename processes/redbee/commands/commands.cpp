#include "processes/redbee/commands/commands.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <string>

#include "processes/redbee/calibrate/calibrate.hpp"
#include "processes/redbee/commands/simulate.hpp"
#include "processes/redbee/detect/collect.hpp"
#include "processes/redbee/detect/detect.hpp"
#include "processes/redbee/evaluate/evaluate.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/evaluate/report.hpp"
#include "processes/redbee/vehicle/doctor.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/bus/receive_buffer.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {

void addDetectCommand(CLI::App& app) {
  auto options = std::make_shared<DetectOptions>();
  auto* command = app.add_subcommand(
      "detect", "run the whole stack over a recorded flight, in one process, no frame lost");
  command->add_option("--log", options->log, "the flight, an LCM log")->required();
  command->add_option("--config", options->configuration, "the vehicle's YAML file")->required();
  command->add_option("--out", options->out, "folder for maps, tables and summary.json")->required();
  command
      ->add_option(
          "--method", options->method,
          "redbee: as configured; default, paper: that preset; else a rival (README). All: " + methodList())
      ->capture_default_str();
  command->add_option("--set", options->settings, "key=value on top of the configuration, as often as needed")
      ->allow_extra_args(false);
  command->add_option("--frames", options->frames, "only the first so many frames of the log")
      ->check(CLI::PositiveNumber);
  auto* rate = command->add_option("--rate", options->rate, "pace: 1 is the log's own speed")
                   ->check(CLI::PositiveNumber);
  command->add_flag("--max-rate", "as fast as it goes (what happens unless --rate is given)")->excludes(rate);
  command->callback([options] {
    const int64_t frames = runDetect(*options);
    std::printf("%lld frames, results in %s\n", static_cast<long long>(frames), options->out.c_str());
  });
}

void addCollectCommand(CLI::App& app) {
  auto options = std::make_shared<CollectOptions>();
  options->url = kDefaultLcmUrl;
  auto* command =
      app.add_subcommand("collect", "write down what running processes say, until SIGINT or SIGTERM");
  command->add_option("--config", options->configuration, "the vehicle's YAML file")->required();
  command->add_option("--lcm-url", options->url, "where the messages are")->capture_default_str();
  command->add_option("--out", options->out, "folder for maps, tables and summary.json")->required();
  command->callback([options] {
    const int64_t frames = runCollect(*options);
    std::printf("%lld frames, results in %s\n", static_cast<long long>(frames), options->out.c_str());
  });
}

void addOverlayCommand(CLI::App& app) {
  auto options = std::make_shared<OverlayOptions>();
  auto* command = app.add_subcommand("overlay", "draw a run's results over its flight, as a video");
  command->add_option("--log", options->log, "the flight")->required();
  command->add_option("--config", options->configuration, "the vehicle's YAML file")->required();
  command->add_option("--results", options->results, "folder of detect or collect")->required();
  command->add_option("--out", options->video, "the MP4 to write")->required();
  command->add_option("--stills", options->stills, "folder for single images too");
  command->callback([options] { renderOverlay(*options); });
}

void addReportCommand(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  auto* command = app.add_subcommand("report", "one page of figures and images about a run");
  command->add_option("--log", options->log, "the flight")->required();
  command->add_option("--config", options->configuration, "the vehicle's YAML file")->required();
  command->add_option("--results", options->results, "folder of detect or collect")->required();
  command->add_option("--truth", options->truth, "folder of truth masks, for the measures");
  command->add_option("--out", options->page, "the HTML file to write")->required();
  command->callback([options] { writeReport(*options); });
}

void addEvaluateCommand(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  auto* command = app.add_subcommand("evaluate", "measure a run's maps against truth masks");
  command
      ->add_option(
          "--truth", options->truth,
          "folder of masks, or a flight or sequence folder with labels/mask or mask; none: nothing moves")
      ->required();
  command->add_option("--detections", options->results, "folder of detect or collect")->required();
  command->add_option("--log", options->log,
                      "the flight: for images of hits and misses, and for masks named by frame number");
  command->add_option("--camera", options->camera_channel, "channel of the log's images")
      ->capture_default_str();
  command->add_option("--frames", options->frames, "only the first so many frames of the recording")
      ->check(CLI::PositiveNumber);
  command->callback([options] { runEvaluate(*options); });
}

void addSimulateCommand(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  auto* command = app.add_subcommand("simulate", "make a flight with exact truth");
  command->add_option("--scenario", options->scenario, "which: " + scenarioNames())->capture_default_str();
  command->add_option("--seed", options->seed, "the same seed gives the same flight")->capture_default_str();
  command->add_option("--seconds", options->seconds)->check(CLI::Range(0.2, 600.0))->capture_default_str();
  command->add_option("--out", options->log, "the log to write; its configuration goes beside it")
      ->required();
  command->add_option("--truth", options->truth, "folder for masks and homographies");
  command->callback([options] { runSimulate(*options); });
}

void addDoctorCommand(CLI::App& app) {
  auto options = std::make_shared<DoctorOptions>();
  options->url = kDefaultLcmUrl;
  auto* command = app.add_subcommand(
      "doctor", "what stands between this machine and a running stack, with the mend of each");
  command->add_option("--lcm-url", options->url)->capture_default_str();
  command->add_option("--camera", options->camera_channel, "channel of the images")->capture_default_str();
  command->add_option("--imu", options->imu_channel, "channel of the IMU")->capture_default_str();
  command->callback([options] {
    if (runDoctor(*options) > 0) throw CLI::RuntimeError(1);
  });
}

int runTool(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("redbee"));
  CLI::App app("REDBEE " REDBEE_VERSION ": moving objects, seen from a drone", "redbee");
  app.set_version_flag("--version", buildVersion());
  app.require_subcommand(1);
  addImportCommand(app);
  addDetectCommand(app);
  addCollectCommand(app);
  addOverlayCommand(app);
  addReportCommand(app);
  addEvaluateCommand(app);
  addCompareCommand(app);
  addConfigurationCommand(app);
  addReferenceExtrinsicsCommand(app);
  addSimulateCommand(app);
  addCalibrateCommand(app);
  addDoctorCommand(app);
  addTopCommand(app);
  addWatchCommand(app);
  addRecordCommand(app);
  cv::setNumThreads(1);  // figures for one core, and the same sums on every machine
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "redbee: %s (redbee --help tells the use)\n", error.what());
    return 2;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const ConfigurationError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "%s: %s\n", error.path1().c_str(), error.code().message().c_str());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "redbee: %s\n", error.what());
    return 1;
  }
}

}  // namespace redbee
