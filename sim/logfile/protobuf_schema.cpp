#include "sim/logfile/protobuf_schema.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "sim/logfile/protobuf_writer.h"

namespace hedgehop::sim {
namespace {

// Field numbers and values of google/protobuf/descriptor.proto, version 3.
enum FileField : uint32_t { kFileName = 1, kPackage = 2, kDependency = 3, kMessageType = 4, kSyntax = 12 };
enum MessageField : uint32_t { kMessageName = 1, kField = 2, kEnumType = 4 };
enum FieldField : uint32_t { kFieldName = 1, kNumber = 3, kLabel = 4, kType = 5, kTypeName = 6 };
enum EnumField : uint32_t { kEnumName = 1, kValue = 2, kValueName = 1, kValueNumber = 2 };
enum FieldLabel : uint32_t { kOptional = 1, kRepeated = 3 };
enum FieldType : uint32_t { kMessage = 11, kEnum = 14 };

const std::map<std::string, uint32_t, std::less<>> kScalarTypes = {
    {"double", 1}, {"int64", 3}, {"int32", 5}, {"fixed32", 7}, {"bool", 8}, {"string", 9}, {"bytes", 12}};

std::string_view package_of(std::string_view full_name) { return full_name.substr(0, full_name.rfind('.')); }

std::string file_of(std::string_view package) {
  std::string file(package);
  std::ranges::replace(file, '.', '/');
  return file + ".proto";
}

bool is_enum(const ProtobufMessage& message, const std::string& type) {
  return std::ranges::find(message.enums, type, &ProtobufEnum::name) != message.enums.end();
}

/// The messages that one message contains, and itself.
class Closure {
 public:
  explicit Closure(std::span<const ProtobufMessage> messages) : messages_(messages) {}

  void add(std::string_view name) {
    if (std::ranges::find(names_, name) != names_.end()) return;
    const auto message = std::ranges::find(messages_, name, &ProtobufMessage::name);
    if (message == messages_.end()) throw std::invalid_argument(std::string(name) + ": no such message");
    names_.emplace_back(name);
    const size_t at = found_.size();
    found_.push_back(&*message);
    for (const ProtobufField& field : found_[at]->fields) {
      if (!kScalarTypes.contains(field.type) && !is_enum(*found_[at], field.type)) add(field.type);
    }
  }

  const std::vector<const ProtobufMessage*>& found() const { return found_; }

 private:
  std::span<const ProtobufMessage> messages_;
  std::vector<std::string> names_;
  std::vector<const ProtobufMessage*> found_;
};

ProtobufWriter described(const ProtobufMessage& message, const ProtobufField& field) {
  ProtobufWriter out;
  out.add_bytes(kFieldName, field.name).add_integer(kNumber, field.number);
  out.add_integer(kLabel, field.repeated ? kRepeated : kOptional);
  if (const auto scalar = kScalarTypes.find(field.type); scalar != kScalarTypes.end()) {
    out.add_integer(kType, scalar->second);
  } else if (is_enum(message, field.type)) {
    out.add_integer(kType, kEnum).add_bytes(kTypeName, "." + message.name + "." + field.type);
  } else {
    out.add_integer(kType, kMessage).add_bytes(kTypeName, "." + field.type);
  }
  return out;
}

ProtobufWriter described(const ProtobufEnum& kind) {
  ProtobufWriter out;
  out.add_bytes(kEnumName, kind.name);
  for (size_t i = 0; i < kind.values.size(); ++i) {
    out.add_message(kValue, ProtobufWriter().add_bytes(kValueName, kind.values[i]).add_integer(kValueNumber, i));
  }
  return out;
}

ProtobufWriter described(const ProtobufMessage& message) {
  ProtobufWriter out;
  out.add_bytes(kMessageName, message.name.substr(package_of(message.name).size() + 1));
  for (const ProtobufField& field : message.fields) out.add_message(kField, described(message, field));
  for (const ProtobufEnum& kind : message.enums) out.add_message(kEnumType, described(kind));
  return out;
}

/// A package of the set, whose file is described.
struct Package {
  std::vector<const ProtobufMessage*> messages;
  std::set<std::string> needs;  ///< other packages
};

ProtobufWriter described(const std::string& name, const Package& package) {
  ProtobufWriter out;
  out.add_bytes(kFileName, file_of(name)).add_bytes(kPackage, name);
  for (const std::string& needed : package.needs) out.add_bytes(kDependency, file_of(needed));
  for (const ProtobufMessage* message : package.messages) out.add_message(kMessageType, described(*message));
  out.add_bytes(kSyntax, "proto3");
  return out;
}

}  // namespace

std::string file_descriptor_set(std::string_view name, std::span<const ProtobufMessage> messages) {
  Closure closure(messages);
  closure.add(name);
  std::map<std::string, Package> packages;
  for (const ProtobufMessage* message : closure.found()) {
    const std::string package(package_of(message->name));
    packages[package].messages.push_back(message);
    for (const ProtobufField& field : message->fields) {
      const std::string_view other = package_of(field.type);
      const bool is_message = field.type.find('.') != std::string::npos;
      if (is_message && other != package) packages[package].needs.emplace(other);
    }
  }
  ProtobufWriter set;
  while (!packages.empty()) {
    const auto ready = std::ranges::find_if(packages, [&](const auto& entry) {
      return std::ranges::none_of(entry.second.needs, [&](const std::string& n) { return packages.contains(n); });
    });
    if (ready == packages.end()) throw std::invalid_argument("the packages of a schema depend on each other");
    set.add_message(1, described(ready->first, ready->second));
    packages.erase(ready);
  }
  return set.bytes();
}

}  // namespace hedgehop::sim
