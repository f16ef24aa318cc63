#include "sim/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "sim/batch/folders.h"
#include "sim/batch/record.h"
#include "sim/config/numbers.h"
#include "sim/config/whole_file.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

/// Returns a column of numbers if all values are numbers, so that tables can be sorted and averaged; else of words.
Table::Column value_column(const std::string& name, const std::vector<std::string>& texts) {
  constexpr int64_t kMaxExactInteger = int64_t{1} << 53;
  std::vector<double> numbers;
  bool whole = true;
  for (const std::string& text : texts) {
    const std::optional<int64_t> integer = parse_signed(text);
    const ParsedNumber parsed = parse_number(text, false);
    const bool exact = !integer || (*integer <= kMaxExactInteger && *integer >= -kMaxExactInteger);
    if (parsed.kind != ParsedNumber::Kind::number || !exact) return {.name = name, .values = texts};
    numbers.push_back(parsed.member);
    whole = whole && integer;
  }
  return {.name = name, .values = std::move(numbers), .whole = whole};
}

std::string header(const SlurmJob& job, std::string_view name, std::string_view log, size_t cores) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --chdir={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n"
      "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n",
      name, shell_quoted(job.folder.string()), shell_quoted((job.out / "slurm" / log).string()), cores);
  for (const std::string& option : job.options) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

std::string sweep_command(const SlurmJob& job) {
  std::string options = job.worker.empty() ? "" : " --program " + shell_quoted(job.worker.string());
  if (job.other_builds) options += " --reuse-other-builds";
  for (const std::string& text : job.overrides) options += " --set " + shell_quoted(text);
  return fmt::format("{} sweep {} --out {}{}", shell_quoted(job.program.string()), shell_quoted(job.sweep.string()),
                     shell_quoted(job.out.string()), options);
}

/// Submits a script. @param options  of sbatch, quoted. @return the number of the job, digits. Throws
/// std::runtime_error with the messages of sbatch in one line if it fails or prints no number.
std::string sbatch(const std::string& options, const std::filesystem::path& script) {
  const std::string command = fmt::format("sbatch --parsable{} {}", options, shell_quoted(script.string()));
  const std::filesystem::path messages = script.parent_path() / "sbatch.log";  // sites write notices even on success
  FILE* const pipe = ::popen(fmt::format("{} 2>{}", command, shell_quoted(messages.string())).c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot start a shell");
  std::string text;
  std::array<char, 256> buffer{};
  while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  const int status = ::pclose(pipe);
  const std::string last = last_line(text);                   // sites write notices before it
  const std::string number = last.substr(0, last.find(';'));  // "4711;cluster" of a federation
  if (status == 0 && parse_unsigned(number)) return number;
  text += read_file_whole(messages);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (size_t end = 0; (end = text.find('\n', end)) != std::string::npos;) text.replace(end, 1, "; ");
  const std::string_view why = status == 0 ? "printed no job number, so the job may be submitted" : "failed";
  throw std::runtime_error(fmt::format("{} {}{}{}", command, why, text.empty() ? "" : ": ", text));
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  const auto index = parse_unsigned(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : parse_unsigned(text.substr(slash + 1));
  if (!index || !of || *index < 1 || *index > *of) {
    throw InputError(fmt::format("--shard {}: expected a shard such as 2/8, from 1/8 to 8/8", text));
  }
  return {static_cast<size_t>(*index), static_cast<size_t>(*of)};
}

void SweepOrders::add(Order order, const std::vector<std::string>& point_values, const std::string& point) {
  orders.push_back(std::move(order));
  values.push_back(point_values);
  points.push_back(point);
}

void SweepOrders::append(const SweepOrders& more) {
  orders.insert(orders.end(), more.orders.begin(), more.orders.end());
  values.insert(values.end(), more.values.begin(), more.values.end());
  points.insert(points.end(), more.points.begin(), more.points.end());
}

Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records,
                  const std::vector<Table::Column>& before) {
  std::vector<Table::Column> extra = before;
  extra.push_back(value_column("point", orders.points));
  for (size_t i = 0; i < sweep.parameters.size(); ++i) {
    std::vector<std::string> texts;
    for (const auto& values : orders.values) texts.push_back(values.at(i));
    extra.push_back(value_column(sweep.parameters[i].path, texts));
  }
  return flight_table(records, extra);
}

std::string array_script(const SlurmJob& job) {
  const std::string limit = job.limit_s > 0.0 ? fmt::format(" --limit {}", job.limit_s) : "";
  return header(job, "hedgehop-sweep", "shard-%a.log", job.cores) +
         fmt::format(
             "#SBATCH --array=1-{0}\n#SBATCH --requeue\n"
             "{1} --shard $SLURM_ARRAY_TASK_ID/{0} -j {2}{3}\nstatus=$?\n"
             "# A failed check is a result. A flight without a result is repeated once, perhaps on another node.\n"
             "missing=$({1} --shard $SLURM_ARRAY_TASK_ID/{0} --missing) || exit $status\n"
             "if [ \"$missing\" != 0 ] && [ \"${{SLURM_RESTART_COUNT:-0}}\" = 0 ]; then\n"
             "  scontrol requeue ${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\n  sleep 60  # until Slurm ends this "
             "try\n"
             "fi\nexit $status\n",
             job.tasks, sweep_command(job), job.cores, limit);
}

std::string merge_script(const SlurmJob& job) {
  const std::string junit = job.junit.empty() ? "" : " --junit " + shell_quoted(job.junit.string());
  return header(job, "hedgehop-merge", "merge.log", 1) +
         "# Hedgehop submits this script with --dependency=afterany:JOB, the number of the job array.\n" +
         sweep_command(job) + " --merge" + junit + "\n";
}

std::string submit(const SlurmJob& job) {
  create_folders(job.out / "slurm");
  const std::filesystem::path array = job.out / "slurm/array.sh", merge = job.out / "slurm/merge.sh";
  write_file_whole(array, array_script(job));
  write_file_whole(merge, merge_script(job));
  const std::string number = sbatch("", array);
  try {
    sbatch(" --dependency=afterany:" + number, merge);  // afterany: the merge reports failures too
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("job {} is submitted, but not the merge: {}", number, error.what()));
  }
  return number;
}

}  // namespace hedgehop::sim
