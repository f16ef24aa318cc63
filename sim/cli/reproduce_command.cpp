#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/fly_orders.h"
#include "sim/batch/folders.h"
#include "sim/cli/commands.h"
#include "sim/cli/every_write.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/progress.h"
#include "sim/config/folder_lock.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/pages/report_page.h"
#include "sim/pages/reproduction_page.h"

#include "sim/reproduce/results_page.h"
#include "sim/simulation/libraries.h"

namespace hedgehop::sim::cli {
namespace {

namespace fs = std::filesystem;
using Status = FlightRecord::Status;

/// The file of a paper's key, or the file itself.
fs::path paper_file(const std::string& name) {
  if (name.ends_with(".yaml")) return name;
  const std::vector<fs::path> files = shipped_files("papers");
  for (const fs::path& file : files) {
    if (file.stem() == name) return file;
  }
  std::vector<std::string> keys;
  for (const fs::path& file : files) keys.push_back(file.stem().string());
  throw InputError(fmt::format("no paper is called '{}'; there are: {}", name, fmt::join(keys, ", ")));
}

std::vector<Paper> read_papers(const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(paper_file(name));
  if (names.empty()) files = shipped_files("papers");
  std::vector<Paper> papers;
  std::vector<std::string> errors;
  std::map<std::string, fs::path> file_of;  // a key is the folder of the paper's flights
  for (const fs::path& file : files) {
    try {
      papers.push_back(read_paper(file));
      const std::string& key = papers.back().key;
      if (const auto [known, added] = file_of.try_emplace(key, file); !added) {
        errors.push_back(fmt::format("two papers are called '{}': {}, {}", key, known->second.string(), file.string()));
      }
    } catch (const InputError& error) {
      errors.insert(errors.end(), error.errors().begin(), error.errors().end());
    }
  }
  if (!errors.empty()) throw InputError(errors);
  return papers;
}

/// Flies the missing flights of all papers as one campaign, so that the remaining time covers all. Ids begin with the
/// paper's key.
std::vector<FlightRecord> fly(const std::vector<Paper>& papers, const ReproduceOptions& options, const fs::path& out,
                              Interruption& interruption) {
  std::vector<Order> orders;
  for (const Paper& paper : papers) {
    for (Order& order : paper_orders(paper, options.quick)) {
      order.id = paper.key + "/" + order.id;
      orders.push_back(std::move(order));
    }
  }
  CampaignProgress progress(orders.size());
  const FlyOptions fly{.program = options.program.empty() ? own_program() : options.program,
                       .out = out,
                       .other_builds = options.reuse_other_builds,
                       .workers = options.jobs,
                       .limit_s = options.limit_s};
  auto records = fly_shown(orders, fly, interruption, progress);
  progress.close();
  return records;
}

/// Returns the renderer of a flight in short: "renderer tiles", "renderer Mesa 22.3.6".
std::string short_renderer(const std::string& info) {
  if (info.find("tiles") != std::string::npos) return "renderer tiles";
  const size_t mesa = info.find("Mesa ");
  return "renderer " +
         (mesa == std::string::npos ? info : info.substr(mesa, info.find_first_of(" ,)\n", mesa + 5) - mesa));
}

std::set<std::string> renderers_of(const std::vector<FlightRecord>& records) {
  std::set<std::string> renderers;
  for (const FlightRecord& record : records) {
    if (!record.result) continue;
    const std::string& renderer = record.result->flight.libraries.renderer;
    renderers.insert(short_renderer(renderer.empty() ? "unknown" : renderer));
  }
  return renderers;
}

/// Writes the page of --write, and prints a line for each section of the earlier page that it lacks.
void write_results_page(const fs::path& file, const RowsOfPapers& papers, const PageFacts& facts) {
  create_folders(file.parent_path());
  const std::string earlier = fs::exists(file) ? read_file_whole(file) : "";
  const std::string page = results_page(papers, facts, earlier);
  write_file_whole(file, page);
  for (const std::string& heading : dropped_sections(earlier, page)) {
    notice(fmt::format("{}: removed the section '{}': not written by this build with these packages\n", file.string(),
                       heading));
  }
}

void write_pages(const ReproduceOptions& options, const fs::path& out, const RowsOfPapers& papers,
                 const nlohmann::ordered_json& pages, const std::vector<FlightRecord>& records) {
  const PageFacts facts = page_facts(papers, package_versions(), options.quick, renderers_of(records));
  const std::string text = results_page(papers, facts);
  EveryWrite files;
  bool has_page = false;
  files.attempt([&] {
    fs::create_directories(out);
    write_file_whole(out / "reproduction.md", text);
  });
  files.attempt([&] { write_file_whole(out / "reproduction.csv", rows_csv(papers)); });
  files.attempt([&] {
    try {
      write_file_whole(out / "reproduction.html", reproduction_page(pages, facts));
      has_page = true;
    } catch (const PagesAbsent& absent) {
      notice(fmt::format("{}\n", absent.what()));
    }
  });
  if (!options.write.empty()) {
    files.attempt([&] { write_results_page(options.write, papers, facts); });
  }
  if (const std::string several = several_builds_line(facts); !several.empty()) fmt::print("{}\n", several);
  if (options.quick) fmt::print("{}\n", kQuickRun);
  for (const auto& [paper, rows] : papers) fmt::print("{}\n", rows_text(paper, rows));
  files.raise();
  if (has_page) fmt::print("written: {}\n", (out / "reproduction.html").string());
  if (!options.write.empty()) fmt::print("written: {}\n", options.write.string());
}

}  // namespace

int reproduce(const ReproduceOptions& options) {
  if (options.quick && !options.write.empty())
    throw InputError("--write is not valid with --quick: a quick run gives no results");
  const std::vector<Paper> papers = read_papers(options.papers);
  const fs::path out = options.out.empty() ? fs::path("out") / "reproduce" : options.out;
  require_writable(out);
  const FolderLock lock(out);
  if (!options.write.empty()) require_writable_file(options.write);
  Interruption interruption;
  const std::vector<FlightRecord> records = fly(papers, options, out, interruption);
  if (interruption.signal() != 0) {
    const auto flown = std::ranges::count(records, Status::flown, [](const auto& record) { return record.status; });
    notice(fmt::format("interrupted: {} of {} flights are there; continue with the same command\n", flown,
                       records.size()));
    return kSignalled + interruption.signal();
  }

  nlohmann::ordered_json pages = nlohmann::ordered_json::array();
  RowsOfPapers rows_of_papers;
  for (const Paper& paper : papers) {
    std::vector<FlightRecord> own;
    std::ranges::copy_if(records, std::back_inserter(own),
                         [&](const FlightRecord& record) { return record.order.id.starts_with(paper.key + "/"); });
    const PaperOutcome outcome = paper_outcome(paper, out, own);
    const std::vector<RowOutcome> rows = row_outcomes(outcome);
    pages.push_back(paper_data(outcome, rows));
    rows_of_papers.emplace_back(paper, rows);
  }
  print_failed(records);
  write_pages(options, out, rows_of_papers, pages, records);
  const bool all_flown = std::ranges::all_of(records, [](const auto& r) { return r.status == Status::flown; });
  const bool rows_hold = std::ranges::all_of(rows_of_papers, [](const auto& paper) { return all_hold(paper.second); });
  return all_flown && rows_hold ? 0 : kFails;
}

}  // namespace hedgehop::sim::cli
