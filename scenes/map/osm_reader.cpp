// Reads OpenStreetMap files with libosmium. The headers are large, so the code is a library of its own.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/area/problem_reporter.hpp>
#include <osmium/handler.hpp>
#include <osmium/handler/check_order.hpp>
#include <osmium/handler/node_locations_for_ways.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>
#include <set>
#include <stdexcept>
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

/// Returns the first node without a place; null if all have one.
const osmium::NodeRef* first_lost(const osmium::NodeRefList& nodes) {
  const auto lost = std::ranges::find_if(nodes, [](const osmium::NodeRef& node) { return !node.location().valid(); });
  return lost == nodes.end() ? nullptr : &*lost;
}

std::string lacks(osmium::object_id_type node) {
  return "its node " + std::to_string(node) + " is absent or has no valid coordinates";
}

/// Returns the points of a list of nodes, all with places, without repetition.
std::vector<GeoPoint> points_of(const osmium::NodeRefList& nodes) {
  std::vector<GeoPoint> points;
  osmium::Location last;
  for (const osmium::NodeRef& node : nodes) {
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

/// Ids that occurred. Files are usually sorted, so each id is compared with the last one first.
class SeenIds {
 public:
  /// Returns whether the id is new.
  bool add(osmium::object_id_type id) {
    if (ascending_.empty() || id > ascending_.back()) {
      ascending_.push_back(id);
      return true;
    }
    return !std::ranges::binary_search(ascending_, id) && others_.insert(id).second;
  }

 private:
  std::vector<osmium::object_id_type> ascending_;
  std::set<osmium::object_id_type> others_;
};

/// Removes deleted objects, and objects with the id of an earlier one: libosmium cannot assemble areas from them.
class UniqueObjects {
 public:
  /// @param[out] faults  receives a line for each repeated id; may be null.
  void filter(osmium::memory::Buffer& buffer, std::vector<std::string>* faults) {
    bool removes = false;
    for (osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) {
      const bool is_new = seen_[object.type()].add(object.id());
      if (!is_new && faults != nullptr)
        faults->push_back(name_of(object) + ": its id occurs more than once; only the first object is read");
      if (is_new && object.visible()) continue;
      object.set_removed(true);
      removes = true;
    }
    if (removes) buffer.purge_removed();
  }

 private:
  std::map<osmium::item_type, SeenIds> seen_;
};

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
  void report_invalid_location(osmium::object_id_type, osmium::object_id_type node) override { keep(lacks(node)); }

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
    if (has_ways_) throw osmium::out_of_order_error("Node after a way", node.id());
    if (is_building(node.tags())) report(node, "a building without an outline");
    if (!node.tags().has_tag("natural", "tree")) return;
    if (!node.location().valid()) return report(node, "its coordinates are absent or out of range");
    objects_.trees.push_back({name_of(node), tags_of(node), place_of(node.location())});
  }

  void way(const osmium::Way& way) {
    has_ways_ = true;
    if (is_building(way.tags())) return expect_outline(way);
    if (is_part(way)) return report(way, kPartFault);
    const bool is_row = way.tags().has_tag("natural", "tree_row");
    if (!is_row && !way.tags().has_key("highway")) return;
    if (const osmium::NodeRef* lost = first_lost(way.nodes())) return report(way, lacks(lost->ref()));
    OsmLine line{name_of(way), tags_of(way), points_of(way.nodes())};
    if (line.points.size() < 2) return report(way, "it has fewer than 2 different points");
    (is_row ? objects_.tree_rows : objects_.streets).push_back(std::move(line));
  }

  void relation(const osmium::Relation& relation) {
    const bool is_polygon = relation.tags().has_tag("type", "multipolygon");
    if (is_building(relation.tags())) {
      if (!is_polygon) return report(relation, "a building that is not a multipolygon is not drawn");
      outlines_.push_back(name_of(relation));
    } else if (is_part(relation)) {
      report(relation, kPartFault);
    } else if (is_polygon && relation.tags().size() == 1 && has_building(relation)) {
      report(relation, "it has no tags, so the building of its outer way is drawn without holes");
    }
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
  static constexpr const char* kPartFault = "building:part is not drawn";
  static bool is_part(const osmium::OSMObject& object) {
    return object.tags().has_key("building:part") && !object.tags().has_tag("building:part", "no");
  }

  bool has_building(const osmium::Relation& relation) const {
    return std::ranges::any_of(relation.members(), [&](const osmium::RelationMember& member) {
      return member.type() == osmium::item_type::way && building_ways_.contains(member.ref());
    });
  }

  /// Notes an outline, or reports one that the assembler ignores.
  void expect_outline(const osmium::Way& way) {
    building_ways_.insert(way.id());
    const auto& nodes = way.nodes();
    if (const osmium::NodeRef* lost = first_lost(nodes)) return report(way, lacks(lost->ref()));
    if (nodes.empty() || !way.ends_have_same_location()) return report(way, "its outline is open");
    if (nodes.size() < 4) return report(way, "its outline has fewer than 3 corners");
    if (way.tags().has_tag("area", "no")) return report(way, "its tag area=no contradicts building");
    outlines_.push_back(name_of(way));
  }

  void report(const osmium::OSMObject& object, const std::string& why) {
    objects_.faults.push_back(name_of(object) + ": " + why);
  }

  OsmObjects& objects_;
  bool has_ways_ = false;
  std::vector<std::string> outlines_;
  std::set<osmium::object_id_type> building_ways_;
};

/// Reads the file twice: the first pass finds the relations whose members the second one keeps.
void read_file(const osmium::io::File& file, OsmObjects& read) {
  FirstProblems problems;
  osmium::area::Assembler::config_type config;
  config.problem_reporter = &problems;
  config.create_empty_areas = false;
  osmium::TagsFilter filter{false};
  filter.add_rule(true, "building");
  osmium::area::MultipolygonManager<osmium::area::Assembler> relations(config, filter);
  UniqueObjects first_pass, second_pass;
  osmium::io::Reader relation_reader(file, osmium::osm_entity_bits::relation);
  while (osmium::memory::Buffer buffer = relation_reader.read()) {
    first_pass.filter(buffer, nullptr);
    osmium::apply(buffer, relations);
  }
  relation_reader.close();
  relations.prepare_for_lookup();

  Index places, places_of_negative_ids;
  Locations locations(places, places_of_negative_ids);
  locations.ignore_errors();
  Objects objects(read);
  Areas areas(read);
  auto& assembler = relations.handler([&](const osmium::memory::Buffer& buffer) { osmium::apply(buffer, areas); });
  osmium::io::Reader reader(file);
  while (osmium::memory::Buffer buffer = reader.read()) {
    second_pass.filter(buffer, &read.faults);
    osmium::apply(buffer, locations, objects, assembler);
  }
  reader.close();
  relations.for_each_incomplete_relation(
      [&](const osmium::relations::RelationHandle& incomplete) { problems.note_incomplete(*incomplete); });
  objects.finish(problems);
}

}  // namespace
}  // namespace hedgehop::scenes::map

/// @see hedgehop::scenes::map::ReadOsm
extern "C" void hedgehop_read_osm(const std::filesystem::path& path, hedgehop::scenes::map::OsmObjects& read) {
  try {
    hedgehop::scenes::map::read_file(osmium::io::File(path.string()), read);
  } catch (const osmium::out_of_order_error& fault) {
    throw std::runtime_error(std::string(fault.what()) +
                             "; a file must have its nodes first, then ways, then relations, each sorted by id");
  }
}
