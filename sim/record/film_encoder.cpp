#include "sim/record/film_encoder.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace hedgehop::sim {
namespace {

/// Bits per pixel and image, sufficient for rendered scenes: 1.4 Mbit/s for 1000 x 700 px at 25 Hz.
constexpr double kBitsPerPixel = 0.08;
/// Maximum time between key frames, for fast seeking.
constexpr double kKeyframePeriodS = 2.0;

template <class T, void (*Free)(T**)>
struct Deleter {
  void operator()(T* object) const { Free(&object); }
};
using CodecContext = std::unique_ptr<AVCodecContext, Deleter<AVCodecContext, avcodec_free_context>>;
using Frame = std::unique_ptr<AVFrame, Deleter<AVFrame, av_frame_free>>;
using Packet = std::unique_ptr<AVPacket, Deleter<AVPacket, av_packet_free>>;

struct FormatDeleter {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
using FormatContext = std::unique_ptr<AVFormatContext, FormatDeleter>;

void check(int code) {
  if (code >= 0) return;
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  throw std::runtime_error(text);
}

CodecContext make_encoder(double rate_hz, cv::Size size_px) {
  const AVCodec* codec = avcodec_find_encoder_by_name("libvpx");
  if (codec == nullptr) throw std::runtime_error("this libavcodec has no VP8 encoder (libvpx)");
  CodecContext encoder(avcodec_alloc_context3(codec));
  encoder->width = size_px.width;
  encoder->height = size_px.height;
  encoder->pix_fmt = AV_PIX_FMT_YUV420P;
  encoder->color_range = AVCOL_RANGE_MPEG;
  encoder->colorspace = AVCOL_SPC_SMPTE170M;
  // A rational number with a large denominator represents any rate with sufficient accuracy.
  encoder->framerate = av_d2q(rate_hz, 1 << 20);
  encoder->time_base = av_inv_q(encoder->framerate);
  encoder->gop_size = std::max(1, static_cast<int>(kKeyframePeriodS * rate_hz));
  encoder->bit_rate = static_cast<int64_t>(kBitsPerPixel * rate_hz * size_px.area());
  encoder->thread_count = 1;  // flights are the unit of parallelism
  av_opt_set(encoder->priv_data, "deadline", "realtime", 0);
  av_opt_set(encoder->priv_data, "cpu-used", "16", 0);
  av_opt_set(encoder->priv_data, "lag-in-frames", "0", 0);
  return encoder;
}

class Vp8Encoder : public FilmEncoder {
 public:
  Vp8Encoder(const std::filesystem::path& file, double rate_hz, cv::Size size_px) : size_px_(size_px) {
    av_log_set_level(AV_LOG_ERROR);
    AVFormatContext* format = nullptr;
    check(avformat_alloc_output_context2(&format, nullptr, "webm", nullptr));
    format->flags |= AVFMT_FLAG_BITEXACT;  // without random identifiers, so that equal flights give equal films
    format_.reset(format);
    encoder_ = make_encoder(rate_hz, size_px_);
    check(avcodec_open2(encoder_.get(), nullptr, nullptr));
    stream_ = avformat_new_stream(format, nullptr);
    check(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    check(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE));
    check(avformat_write_header(format, nullptr));
    packet_.reset(av_packet_alloc());
    frame_.reset(av_frame_alloc());
    frame_->format = AV_PIX_FMT_YUV420P;
    frame_->width = size_px_.width;
    frame_->height = size_px_.height;
  }

  void add(const cv::Mat& i420) override {
    point_frame_at_planes(i420);
    frame_->pts = images_++;
    encode(frame_.get());
  }

  void finish() override {
    encode(nullptr);
    check(av_write_trailer(format_.get()));
    check(avio_closep(&format_->pb));
    format_.reset();
  }

 private:
  /// The encoder copies the image before it returns, so no copy is necessary here.
  void point_frame_at_planes(const cv::Mat& i420) {
    const int luma = size_px_.area(), chroma = luma / 4;
    frame_->data[0] = i420.data;
    frame_->data[1] = i420.data + luma;
    frame_->data[2] = i420.data + luma + chroma;
    frame_->linesize[0] = size_px_.width;
    frame_->linesize[1] = frame_->linesize[2] = size_px_.width / 2;
  }

  void encode(const AVFrame* frame) {
    check(avcodec_send_frame(encoder_.get(), frame));
    while (true) {
      const int code = avcodec_receive_packet(encoder_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      check(code);
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
      check(av_interleaved_write_frame(format_.get(), packet_.get()));
      check(format_->pb->error);
    }
  }

  cv::Size size_px_;
  FormatContext format_;
  CodecContext encoder_;
  AVStream* stream_ = nullptr;
  Packet packet_;
  Frame frame_;
  int64_t images_ = 0;
};

}  // namespace
}  // namespace hedgehop::sim

extern "C" __attribute__((visibility("default"))) void hedgehop_make_film_encoder(
    const std::filesystem::path& file, double rate_hz, cv::Size size_px,
    std::unique_ptr<hedgehop::sim::FilmEncoder>& made) {
  made = std::make_unique<hedgehop::sim::Vp8Encoder>(file, rate_hz, size_px);
}
