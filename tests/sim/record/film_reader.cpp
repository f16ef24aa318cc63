#include "tests/sim/record/film_reader.h"

#include <cstring>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace hedgehop::sim {
namespace {

void check(int code, const char* what) {
  if (code < 0) throw std::runtime_error(std::string("film reader: ") + what);
}

/// Returns the joined planes of a decoded frame.
cv::Mat to_rgb(const AVFrame& frame) {
  const int width = frame.width, height = frame.height;
  cv::Mat yuv(height * 3 / 2, width, CV_8UC1), rgb;
  uint8_t* out = yuv.data;
  for (int plane = 0; plane < 3; ++plane) {
    const int columns = plane == 0 ? width : width / 2, rows = plane == 0 ? height : height / 2;
    for (int row = 0; row < rows; ++row, out += columns) {
      std::memcpy(out, frame.data[plane] + row * frame.linesize[plane], static_cast<size_t>(columns));
    }
  }
  cv::cvtColor(yuv, rgb, cv::COLOR_YUV2RGB_I420);
  return rgb;
}

}  // namespace

ReadFilm read_film(const std::filesystem::path& file) {
  AVFormatContext* format = nullptr;
  check(avformat_open_input(&format, file.c_str(), nullptr, nullptr), "cannot open");
  check(avformat_find_stream_info(format, nullptr), "no stream");
  const AVStream& stream = *format->streams[0];
  AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder_by_name("vp8"));
  check(avcodec_parameters_to_context(decoder, stream.codecpar), "no codec");
  check(avcodec_open2(decoder, nullptr, nullptr), "cannot decode");
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();

  ReadFilm film{.duration_s = static_cast<double>(format->duration) / AV_TIME_BASE, .images = {}};
  while (true) {
    const bool more = av_read_frame(format, packet) >= 0;
    check(avcodec_send_packet(decoder, more ? packet : nullptr), "bad packet");
    if (more) av_packet_unref(packet);
    while (avcodec_receive_frame(decoder, frame) >= 0) {
      film.images.push_back({static_cast<double>(frame->pts) * av_q2d(stream.time_base), to_rgb(*frame)});
    }
    if (!more) break;
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&format);
  return film;
}

}  // namespace hedgehop::sim
