// A GoPro's motion track with any content: two payloads, cut by a line of "%%".
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/gpmf.hpp"
#include "redbee/importers/video_reader.hpp"
#include "tests/fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace redbee;  // NOLINT: a target is one function
  std::vector<DataPacket> packets;
  double start = 0;
  for (const std::string& part : fuzz::parts(data, size, 2)) {
    DataPacket packet;
    packet.start_s = start;
    packet.duration_s = 1;
    packet.bytes.assign(part.begin(), part.end());
    packets.push_back(packet);
    start += 1;
  }
  try {
    mergeAtGyroTimes(readGoproStreams(packets));
  } catch (const GpmfError&) {
  }
  return 0;
}
