#include "sim/record/film.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace hedgehop::sim {
namespace {

/// Bits per pixel and image that keep rendered scenes legible; 1000 x 700 at 25 Hz then takes 1.4 Mbit/s.
constexpr double kBitsPerPixel = 0.08;
/// A whole image at least this often, so that seeking is quick.
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

std::string error_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  return text;
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
  // Time in microticks of an image, so that any rate is exact enough.
  encoder->framerate = av_d2q(rate_hz, 1 << 20);
  encoder->time_base = av_inv_q(encoder->framerate);
  encoder->gop_size = std::max(1, static_cast<int>(kKeyframePeriodS * rate_hz));
  encoder->bit_rate = static_cast<int64_t>(kBitsPerPixel * rate_hz * size_px.area());
  encoder->thread_count = 1;  // the flight is the unit of parallelism
  av_opt_set(encoder->priv_data, "deadline", "realtime", 0);
  av_opt_set(encoder->priv_data, "cpu-used", "16", 0);
  av_opt_set(encoder->priv_data, "lag-in-frames", "0", 0);
  return encoder;
}

}  // namespace

class Film::Impl {
 public:
  Impl(const std::filesystem::path& file, double rate_hz, cv::Size size_px)
      : file_(file), part_(file.string() + ".part"), size_px_(size_px.width & ~1, size_px.height & ~1) {
    if (!(rate_hz > 0.0) || size_px_.area() <= 0) {
      throw std::invalid_argument(fmt::format("film {}: rate {} Hz and size {} x {} must be positive", file.string(),
                                              rate_hz, size_px.width, size_px.height));
    }
    av_log_set_level(AV_LOG_ERROR);
    try {
      open(rate_hz);
    } catch (const std::runtime_error& error) {
      give_up();
      throw std::runtime_error(fmt::format("cannot write film {}: {}", file_.string(), error.what()));
    }
  }

  void add(const cv::Mat& rgb) {
    if (format_ == nullptr) throw std::runtime_error(fmt::format("film {} is closed", file_.string()));
    if (rgb.type() != CV_8UC3 || (rgb.cols & ~1) != size_px_.width || (rgb.rows & ~1) != size_px_.height) {
      throw std::invalid_argument(fmt::format("film {}: image must be RGB of {} x {} px, is {} x {}", file_.string(),
                                              size_px_.width, size_px_.height, rgb.cols, rgb.rows));
    }
    cv::cvtColor(rgb(cv::Rect({0, 0}, size_px_)), yuv_, cv::COLOR_RGB2YUV_I420);
    guarded([&] {
      point_frame_at_planes();
      frame_->pts = images_++;
      encode(frame_.get());
    });
  }

  void close() {
    if (format_ == nullptr) return;
    if (images_ == 0) return give_up();
    guarded([&] {
      encode(nullptr);
      check(av_write_trailer(format_.get()));
      check(avio_closep(&format_->pb));
      format_.reset();
      std::filesystem::rename(part_, file_);
    });
  }

 private:
  void open(double rate_hz) {
    AVFormatContext* format = nullptr;
    check(avformat_alloc_output_context2(&format, nullptr, "webm", nullptr));
    format_.reset(format);
    encoder_ = make_encoder(rate_hz, size_px_);
    check(avcodec_open2(encoder_.get(), nullptr, nullptr));
    stream_ = avformat_new_stream(format, nullptr);
    check(avcodec_parameters_from_context(stream_->codecpar, encoder_.get()));
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    check(avio_open(&format->pb, part_.c_str(), AVIO_FLAG_WRITE));
    check(avformat_write_header(format, nullptr));
    packet_.reset(av_packet_alloc());
    frame_.reset(av_frame_alloc());
    frame_->format = AV_PIX_FMT_YUV420P;
    frame_->width = size_px_.width;
    frame_->height = size_px_.height;
  }

  /// The encoder takes what it keeps of an image before it returns, so the planes of `yuv_` serve without a copy.
  void point_frame_at_planes() {
    const int luma = size_px_.area(), chroma = luma / 4;
    frame_->data[0] = yuv_.data;
    frame_->data[1] = yuv_.data + luma;
    frame_->data[2] = yuv_.data + luma + chroma;
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

  static void check(int code) {
    if (code < 0) throw std::runtime_error(error_text(code));
  }

  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const std::exception& error) {
      give_up();
      throw std::runtime_error(fmt::format("cannot write film {}: {}", file_.string(), error.what()));
    }
  }

  void give_up() {
    format_.reset();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
  }

  std::filesystem::path file_, part_;
  cv::Size size_px_;
  FormatContext format_;
  CodecContext encoder_;
  AVStream* stream_ = nullptr;
  Packet packet_;
  Frame frame_;
  cv::Mat yuv_;
  int64_t images_ = 0;
};

Film::Film(const std::filesystem::path& file_webm, double rate_hz, cv::Size size_px)
    : impl_(std::make_unique<Impl>(file_webm, rate_hz, size_px)) {}
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film::~Film() {
  if (impl_ == nullptr) return;
  try {
    impl_->close();
  } catch (const std::exception&) {  // close() is there for those who want to know
  }
}

void Film::add(const cv::Mat& rgb) { impl_->add(rgb); }
void Film::close() { impl_->close(); }

}  // namespace hedgehop::sim
