#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/map/osm_objects.h"

namespace hedgehop::scenes::map {

/// Reads the tags of one object, and reports those that it cannot read.
class TagReader {
 public:
  /// @param name  of the object, such as "way 12". @param[out] faults  receives one line for each faulty tag.
  TagReader(const std::string& name, const Tags& tags, std::vector<std::string>& faults)
      : name_(name), tags_(tags), faults_(faults) {}

  /// Returns the text of a tag; empty without the tag.
  std::string_view text(const std::string& key) const;

  /// Returns a length: "12", "12.5 m", "40 ft" or 12'6", m [OSM3D2024] sec. on units; nullopt without the tag.
  /// @param at_least, at_most  valid lengths, m.
  std::optional<double> length_m(const std::string& key, double at_least, double at_most) const;

  /// Returns a number from 0 to `at_most` without a unit; nullopt without the tag.
  std::optional<double> number(const std::string& key, double at_most) const;

  /// Returns a direction, from north to east: a number of degrees or a point of the compass, such as NNE, deg; nullopt
  /// without the tag.
  std::optional<double> direction_deg(const std::string& key) const;

  /// Reports the tag: "way 12: height='abc': <valid>".
  void report(const std::string& key, std::string_view valid) const;

 private:
  const std::string& name_;
  const Tags& tags_;
  std::vector<std::string>& faults_;
};

}  // namespace hedgehop::scenes::map
