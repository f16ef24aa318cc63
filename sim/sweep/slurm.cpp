#include "sim/sweep/slurm.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <stdexcept>

#include "sim/batch/order.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

std::string header(const SlurmJob& job, std::string_view name, std::string_view log, size_t cores) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --chdir={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n"
      "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n",
      name, shell_quoted(job.folder.string()), shell_quoted((job.out / "slurm" / log).string()), cores);
  for (const std::string& option : job.options) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

std::string sweep_command(const SlurmJob& job) {
  const std::string worker = job.worker.empty() ? "" : " --program " + shell_quoted(job.worker.string());
  return fmt::format("{} sweep {} --out {}{}", shell_quoted(job.program.string()), shell_quoted(job.sweep.string()),
                     shell_quoted(job.out.string()), worker);
}

/// Runs a shell command; its output without the last line's end.
std::string output_of(const std::string& command) {
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot start a shell");
  std::string text;
  std::array<char, 256> buffer{};
  while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  const int status = ::pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (status != 0) throw std::runtime_error(fmt::format("{}: {}", command, text));
  return text;
}

}  // namespace

std::string array_script(const SlurmJob& job) {
  const std::string limit = job.limit_s > 0.0 ? fmt::format(" --limit {}", job.limit_s) : "";
  return header(job, "hedgehop-sweep", "shard-%a.log", job.cores) +
         fmt::format(
             "#SBATCH --array=1-{0}\n#SBATCH --requeue\n"
             "{1} --shard $SLURM_ARRAY_TASK_ID/{0} -j {2}{3}\nstatus=$?\n"
             "# A failed check is a result; a flight that left none is tried once more, perhaps on another node.\n"
             "missing=$({1} --shard $SLURM_ARRAY_TASK_ID/{0} --missing) || exit $status\n"
             "if [ \"$missing\" != 0 ] && [ \"${{SLURM_RESTART_COUNT:-0}}\" = 0 ]; then\n"
             "  scontrol requeue ${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\n  sleep 60  # until Slurm ends this "
             "try\n"
             "fi\nexit $status\n",
             job.tasks, sweep_command(job), job.cores, limit);
}

std::string merge_script(const SlurmJob& job) {
  const std::string junit = job.junit.empty() ? "" : " --junit " + shell_quoted(job.junit.string());
  return header(job, "hedgehop-merge", "merge.log", 1) + sweep_command(job) + " --merge" + junit + "\n";
}

std::string submit(const SlurmJob& job) {
  std::filesystem::create_directories(job.out / "slurm");
  const std::filesystem::path array = job.out / "slurm/array.sh", merge = job.out / "slurm/merge.sh";
  write_file_whole(array, array_script(job));
  write_file_whole(merge, merge_script(job));
  const std::string number = output_of("sbatch --parsable " + shell_quoted(array.string()));
  // afterany: the merge reports failures too.
  output_of(fmt::format("sbatch --parsable --dependency=afterany:{} {}", number, shell_quoted(merge.string())));
  return number;
}

}  // namespace hedgehop::sim
