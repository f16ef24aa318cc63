// Reads OpenStreetMap files with libosmium. The headers are large, so the code is a library of its own.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/area/problem_reporter.hpp>
#include <osmium/handler.hpp>
#include <osmium/handler/node_locations_for_ways.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>
#include <set>
#include <string>
#include <utility>

#include "scenes/map/osm_objects.h"

namespace hedgehop::scenes::map {
namespace {

using Index = osmium::index::map::FlexMem<osmium::unsigned_object_id_type, osmium::Location>;
using Locations = osmium::handler::NodeLocationsForWays<Index, Index>;

std::string name_of(const osmium::OSMObject& object) {
  return std::string(osmium::item_type_to_name(object.type())) + " " + std::to_string(object.id());
}

bool is_building(const osmium::TagList& tags) { return tags.has_key("building") && !tags.has_tag("building", "no"); }

Tags tags_of(const osmium::OSMObject& object) {
  Tags tags;
  for (const osmium::Tag& tag : object.tags()) tags.emplace(tag.key(), tag.value());
  return tags;
}

GeoPoint place_of(const osmium::Location& location) { return {location.lat(), location.lon()}; }

/// Returns the points of a list of nodes without repetition; empty if the file lacks a node.
std::vector<GeoPoint> points_of(const osmium::NodeRefList& nodes) {
  std::vector<GeoPoint> points;
  osmium::Location last;
  for (const osmium::NodeRef& node : nodes) {
    if (!node.location().valid()) return {};
    if (points.empty() || node.location() != last) points.push_back(place_of(node.location()));
    last = node.location();
  }
  return points;
}

GeoRing ring_of(const osmium::NodeRefList& nodes) {
  GeoRing ring = points_of(nodes);
  if (!ring.empty()) ring.pop_back();
  return ring;
}

/// Remembers the first problem of each area, by its name.
class FirstProblems : public osmium::area::ProblemReporter {
 public:
  std::string of(const std::string& name) const {
    const auto found = texts_.find(name);
    return found == texts_.end() ? "its outline is incomplete or crosses itself" : found->second;
  }

  /// Notes a relation without all of its members, which is not assembled.
  void note_incomplete(const osmium::Relation& relation) {
    texts_.emplace(name_of(relation), "the file lacks members of it");
  }
  void report_intersection(osmium::object_id_type, osmium::Location, osmium::Location, osmium::object_id_type,
                           osmium::Location, osmium::Location, osmium::Location) override {
    keep("its outline crosses itself");
  }
  void report_ring_not_closed(const osmium::NodeRef& node, const osmium::Way*) override {
    keep("its outline is open at node " + std::to_string(node.ref()));
  }
  void report_invalid_location(osmium::object_id_type, osmium::object_id_type node) override {
    keep("the file lacks its node " + std::to_string(node));
  }

 private:
  void keep(const std::string& text) {
    texts_.emplace(std::string(osmium::item_type_to_name(m_object_type)) + " " + std::to_string(m_object_id), text);
  }

  std::map<std::string, std::string> texts_;
};

/// Receives the areas that were assembled.
class Areas : public osmium::handler::Handler {
 public:
  explicit Areas(OsmObjects& objects) : objects_(objects) {}

  void area(const osmium::Area& area) {
    if (!is_building(area.tags())) return;
    OsmArea building{.name = std::string(area.from_way() ? "way " : "relation ") + std::to_string(area.orig_id()),
                     .tags = tags_of(area),
                     .polygons = {}};
    for (const osmium::OuterRing& outer : area.outer_rings()) {
      GeoPolygon& polygon = building.polygons.emplace_back(GeoPolygon{.outer = ring_of(outer), .holes = {}});
      for (const osmium::InnerRing& inner : area.inner_rings(outer)) polygon.holes.push_back(ring_of(inner));
    }
    if (!building.polygons.empty()) objects_.buildings.push_back(std::move(building));
  }

 private:
  OsmObjects& objects_;
};

/// Receives nodes and ways, with the places of their nodes.
class Objects : public osmium::handler::Handler {
 public:
  explicit Objects(OsmObjects& objects) : objects_(objects) {}

  void node(const osmium::Node& node) {
    if (is_building(node.tags())) report(node, "a building without an outline");
    if (!node.tags().has_tag("natural", "tree")) return;
    if (!node.location().valid()) return report(node, "it has no place");
    objects_.trees.push_back({name_of(node), tags_of(node), place_of(node.location())});
  }

  void way(const osmium::Way& way) {
    if (is_building(way.tags())) return expect_outline(way);
    if (way.tags().has_key("building:part")) return report(way, "building:part is not drawn");
    const bool is_row = way.tags().has_tag("natural", "tree_row");
    if (!is_row && !way.tags().has_key("highway")) return;
    OsmLine line{name_of(way), tags_of(way), points_of(way.nodes())};
    if (line.points.size() < 2) return report(way, "the file lacks nodes of it");
    (is_row ? objects_.tree_rows : objects_.streets).push_back(std::move(line));
  }

  void relation(const osmium::Relation& relation) {
    if (!is_building(relation.tags()) || !relation.tags().has_tag("type", "multipolygon")) return;
    outlines_.push_back(name_of(relation));
  }

  /// Reports the outlines of which no area was assembled.
  void finish(const FirstProblems& problems) {
    std::set<std::string> assembled;
    for (const OsmArea& building : objects_.buildings) assembled.insert(building.name);
    for (const std::string& name : outlines_) {
      if (!assembled.contains(name)) objects_.faults.push_back(name + ": " + problems.of(name));
    }
  }

 private:
  /// Notes an outline, or reports one that the assembler ignores.
  void expect_outline(const osmium::Way& way) {
    const auto& nodes = way.nodes();
    if (nodes.size() < 4) return report(way, "its outline has fewer than 3 corners");
    const osmium::Location first = nodes.front().location(), last = nodes.back().location();
    if (!first.valid() || !last.valid()) return report(way, "the file lacks nodes of it");
    if (first != last) return report(way, "its outline is open");
    if (way.tags().has_tag("area", "no")) return report(way, "its tag area=no contradicts building");
    outlines_.push_back(name_of(way));
  }

  void report(const osmium::OSMObject& object, const std::string& why) {
    objects_.faults.push_back(name_of(object) + ": " + why);
  }

  OsmObjects& objects_;
  std::vector<std::string> outlines_;
};

}  // namespace
}  // namespace hedgehop::scenes::map

/// @see hedgehop::scenes::map::ReadOsm
extern "C" void hedgehop_read_osm(const std::filesystem::path& path, hedgehop::scenes::map::OsmObjects& read) {
  using namespace hedgehop::scenes::map;
  const osmium::io::File file(path.string());

  // The first pass finds the relations whose members the second one keeps.
  FirstProblems problems;
  osmium::area::Assembler::config_type config;
  config.problem_reporter = &problems;
  config.create_empty_areas = false;
  osmium::TagsFilter filter{false};
  filter.add_rule(true, "building");
  osmium::area::MultipolygonManager<osmium::area::Assembler> relations(config, filter);
  osmium::relations::read_relations(file, relations);

  Index places, places_of_negative_ids;
  Locations locations(places, places_of_negative_ids);
  locations.ignore_errors();
  Objects objects(read);
  Areas areas(read);
  osmium::io::Reader reader(file);
  osmium::apply(reader, locations, objects,
                relations.handler([&](const osmium::memory::Buffer& buffer) { osmium::apply(buffer, areas); }));
  reader.close();
  relations.for_each_incomplete_relation(
      [&](const osmium::relations::RelationHandle& incomplete) { problems.note_incomplete(*incomplete); });
  objects.finish(problems);
}
