// Prints frames of all messages with random contents, a line of JSON each: {"name", "hex", "fields": {name: value}}.
#include <cstdio>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/frame.h"
#include "sim/mavlink/hil_messages.h"
#include "sim/mavlink/perception_messages.h"

namespace hedgehop::sim::mavlink {
namespace {

/// Fills fields with random values.
class RandomFields {
 public:
  explicit RandomFields(std::mt19937_64& random) : random_(random) {}
  template <class T>
  void operator()(std::string_view, T& value) {
    if constexpr (IsArray<T>::value) {
      for (auto& element : value) (*this)("", element);
    } else if constexpr (std::is_same_v<T, char>) {
      value = static_cast<char>('a' + random_() % 26);
    } else if constexpr (std::is_same_v<T, float>) {
      value =
          random_() % 3 == 0 ? 0.0f : static_cast<float>(static_cast<double>(random_() % 2'000'001) / 777.0 - 1000.0);
    } else {
      value = random_() % 3 == 0 ? T{0} : static_cast<T>(random_());
    }
  }
  void extensions() {}

 private:
  std::mt19937_64& random_;
};

/// Writes fields as JSON; numbers are texts, because those of 64 bits exceed JavaScript's.
class JsonFields {
 public:
  template <class T>
  void operator()(std::string_view name, const T& value) {
    text += (text.empty() ? "\"" : ",\"") + std::string(name) + "\":";
    if constexpr (std::is_same_v<T, std::array<char, 50>>) {
      text += "\"" + std::string(value.begin(), value.end()) + "\"";
    } else if constexpr (IsArray<T>::value) {
      std::string list;
      for (const auto& element : value) list += (list.empty() ? "" : ",") + number(element);
      text += "[" + list + "]";
    } else {
      text += number(value);
    }
  }
  void extensions() {}
  std::string text;

 private:
  template <class T>
  static std::string number(T value) {
    if constexpr (std::is_same_v<T, float>) {
      char digits[32];
      std::snprintf(digits, sizeof digits, "\"%.9g\"", static_cast<double>(value));
      return digits;
    } else {
      return "\"" + std::to_string(value) + "\"";
    }
  }
};

template <class Message>
void print(FrameWriter& writer, std::mt19937_64& random) {
  Message message;
  RandomFields fill(random);
  list_fields(fill, message);
  std::vector<uint8_t> bytes;
  writer.append(message, bytes);
  JsonFields fields;
  list_fields(fields, std::as_const(message));
  std::string hex;
  for (const uint8_t byte : bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    hex += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  std::printf("{\"name\":\"%s\",\"hex\":\"%s\",\"fields\":{%s}}\n", std::string(Message::kName).c_str(), hex.c_str(),
              fields.text.c_str());
}

template <class... Messages>
void print_all(FrameWriter& writer, std::mt19937_64& random) {
  (print<Messages>(writer, random), ...);
}

}  // namespace
}  // namespace hedgehop::sim::mavlink

int main() {
  using namespace hedgehop::sim::mavlink;
  std::mt19937_64 random(1);
  FrameWriter writer({1, 196});
  for (int i = 0; i < 50; ++i) {
    print_all<Heartbeat, Attitude, LocalPositionNed, RcChannelsOverride, CommandLong, CommandAck,
              SetPositionTargetLocalNed, EkfStatusReport, StatusText, ObstacleDistance, DistanceSensor, OpticalFlow,
              OpticalFlowRad, VisionPositionEstimate, Odometry, HilSensor, HilGps, HilStateQuaternion,
              HilActuatorControls>(writer, random);
  }
  return 0;
}
