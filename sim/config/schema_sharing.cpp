#include "sim/config/schema_sharing.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kWorthSharing = 300;  // letters

/// Calls `visit` with each schema right below `schema` and a name for it.
template <class Visit>
void each_part(Json& schema, const std::string& name, Visit visit) {
  for (auto& [keyword, rule] : schema.items()) {
    if (keyword == "properties") {
      for (auto& [key, part] : rule.items()) visit(part, key);
    } else if (keyword == "oneOf" || keyword == "anyOf" || keyword == "allOf") {
      for (Json& part : rule) visit(part, part.value("title", name));
    } else if (keyword == "then" || keyword == "else" || keyword == "items") {
      visit(rule, rule.is_object() ? rule.value("title", name) : name);
    }
  }
}

class Sharing {
 public:
  explicit Sharing(Json& root) : root_(root) {
    each_part(root_, "", [this](Json& part, const std::string&) { count(part); });
    each_part(root_, "", [this](Json& part, const std::string& name) { replace(part, name); });
    if (!definitions_.empty()) root_["$defs"] = std::move(definitions_);
  }

 private:
  // A part within one that was met before is written once with it.
  void count(Json& schema) {
    if (++uses_[schema.dump()] > 1) return;
    each_part(schema, "", [this](Json& part, const std::string&) { count(part); });
  }

  void replace(Json& schema, const std::string& name) {
    const std::string text = schema.dump();
    const bool shared = text.size() >= kWorthSharing && uses_.at(text) > 1;
    std::string& defined = names_[text];
    const bool first = defined.empty();
    if (shared && first) defined = unused(name);
    const std::string reference = "#/$defs/" + defined;
    if (!shared || first) {
      each_part(schema, name, [this](Json& part, const std::string& inner) { replace(part, inner); });
    }
    if (!shared) return;
    if (first) definitions_[reference.substr(std::string_view("#/$defs/").size())] = std::move(schema);
    schema = {{"$ref", reference}};
  }

  std::string unused(const std::string& name) {
    const int number = ++named_[name];
    return number == 1 ? name : fmt::format("{}_{}", name, number);
  }

  Json& root_;
  Json definitions_ = Json::object();
  std::map<std::string, int> uses_, named_;
  std::map<std::string, std::string> names_;  ///< by text
};

}  // namespace

void share_definitions(Json& schema) { Sharing{schema}; }

}  // namespace hedgehop::sim
