#include "sim/batch/usable_cores.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

#include "sim/config/whole_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

/// A folder in place of the root of the file system.
class SystemFolder : public TemporaryFolder {
 public:
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((path() / file).parent_path());
    write_file_whole(path() / file, text);
  }
};

TEST(CpuQuota, IsTheSmallestOfTheGroupsOfVersion2) {
  const SystemFolder root;
  EXPECT_EQ(cpu_quota(root.path()), std::nullopt);
  root.write("proc/self/cgroup", "0::/jobs/mine\n");
  root.write("sys/fs/cgroup/jobs/mine/cpu.max", "max 100000\n");
  EXPECT_EQ(cpu_quota(root.path()), std::nullopt);
  root.write("sys/fs/cgroup/jobs/cpu.max", "150000 100000\n");
  EXPECT_EQ(cpu_quota(root.path()), 1.5);
  root.write("sys/fs/cgroup/jobs/mine/cpu.max", "50000 100000\n");
  EXPECT_EQ(cpu_quota(root.path()), 0.5);
}

TEST(CpuQuota, IsReadInVersion1) {
  const SystemFolder root;
  root.write("proc/self/cgroup", "5:cpuset:/\n4:cpu,cpuacct:/docker/abc\n");
  root.write("sys/fs/cgroup/cpu/docker/abc/cpu.cfs_quota_us", "-1\n");
  root.write("sys/fs/cgroup/cpu/docker/abc/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cpu_quota(root.path()), std::nullopt);
  root.write("sys/fs/cgroup/cpu/docker/abc/cpu.cfs_quota_us", "300000\n");
  EXPECT_EQ(cpu_quota(root.path()), 3.0);
}

/// In a container, /proc names the group of the host, which has no files there.
TEST(CpuQuota, IsThatOfTheTopIfTheGroupHasNoFiles) {
  const SystemFolder root;
  root.write("proc/self/cgroup", "0::/kubepods/pod1\n");
  root.write("sys/fs/cgroup/cpu.max", "200000 100000\n");
  EXPECT_EQ(cpu_quota(root.path()), 2.0);
}

TEST(UsableCores, AreNoMoreThanTheAffinity) {
  std::thread([] {  // the affinity is a thread's
    cpu_set_t one;
    ASSERT_EQ(sched_getaffinity(0, sizeof(one), &one), 0);
    int first = 0;
    while (first < CPU_SETSIZE && !CPU_ISSET(first, &one)) ++first;
    ASSERT_LT(first, CPU_SETSIZE);
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
    EXPECT_EQ(usable_cores(), 1u);
  })
      .join();
}

}  // namespace
}  // namespace hedgehop::sim
