#include "redbee/importers/data_track.hpp"

#include <utility>

#include "redbee/files/ffmpeg.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {

std::vector<DataPacket> readDataTrack(const std::filesystem::path& path, const std::string& tag) {
  // "Advanced" edit lists drop the packets that begin before the cut and leave the times of the rest; the
  // simple ones shift the clock of the track, as the video's is.
  const ffmpeg::Input input = ffmpeg::openInput(path, {{"advanced_editlist", "0"}});
  const AVStream* track = nullptr;
  for (unsigned i = 0; i < input->nb_streams; ++i) {
    AVStream* stream = input->streams[i];
    const uint32_t wanted = MKTAG(tag.at(0), tag.at(1), tag.at(2), tag.at(3));
    const bool matches = stream->codecpar->codec_tag == wanted && track == nullptr;
    if (matches) track = stream;
    stream->discard = matches ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
  }
  std::vector<DataPacket> packets;
  if (track == nullptr) return packets;
  const ffmpeg::Packet packet(av_packet_alloc());
  int read = 0;
  for (; (read = av_read_frame(input.get(), packet.get())) >= 0; av_packet_unref(packet.get())) {
    if (packet->stream_index != track->index) continue;
    DataPacket out;
    out.start_s = static_cast<double>(packet->pts) * av_q2d(track->time_base);
    out.duration_s = static_cast<double>(packet->duration) * av_q2d(track->time_base);
    out.bytes.assign(packet->data, packet->data + packet->size);
    packets.push_back(std::move(out));
  }
  if (read != AVERROR_EOF) {
    throw InputError(path, "its '" + tag + "' track is cut short after packet " +
                               std::to_string(packets.size()) + ": " + ffmpeg::explain(read));
  }
  return packets;
}

}  // namespace redbee
