// `ramify sweep --slurm` and `--collect`, with a stand-in for sbatch. tests/checks/slurm has a real Slurm.

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

// Takes a job as sbatch does; `tasks` are run at once, in a shell of /bin/sh as Slurm's are.
constexpr const char* kSbatch = R"(#!/bin/bash
printf '%s\n' "$@" > "$(dirname "$0")/arguments"
for argument; do
  case $argument in --array=*) list=${argument#*=} ;; --chdir=*) cd "${argument#*=}" || exit 1 ;; esac
done
for task in ${list//,/ }; do
  SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=1 sh "$argument" > "task-$task.log" 2>&1
done
echo '42;cluster'
)";

/// A folder with an sbatch of its own.
class Cluster {
 public:
  explicit Cluster(const std::string& sbatch = kSbatch) {
    fs::create_directory(bin());
    std::ofstream(bin() / "sbatch") << sbatch;
    fs::permissions(bin() / "sbatch", fs::perms::owner_all);
  }

  fs::path bin() const { return folder_.path() / "bin"; }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  std::string text(const std::string& name) const { return read_file(path(name)); }

  Outcome sweep(const std::string& arguments) const {
    return run_program("sweep " + arguments, folder_.path().string(), "PATH='" + bin().string() + "':$PATH ");
  }

  json told(const std::string& arguments) const {
    const Outcome outcome = sweep(arguments + " --json --quiet");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return json::parse(outcome.out);
  }

 private:
  Folder folder_;
};

/// The rows without the columns that depend on the machine: seconds and memory, of which the values have no
/// commas; they are before the last two.
std::string without_costs(const std::string& csv) {
  std::istringstream lines(csv);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t status = line.rfind(',', line.rfind(',') - 1);
    const std::size_t costs = line.rfind(',', line.rfind(',', status - 1) - 1);
    text += line.substr(0, costs) + line.substr(status) + "\n";
  }
  return text;
}

const std::string kSweep = "s4-fig6 --vary seed=1:6:1 --vary steps=3,4";

}  // namespace

TEST_CASE("slurm: an array job makes the runs and --collect gathers what a sweep here gathers") {
  const Cluster cluster;
  const json job = cluster.told(kSweep + " -o out --slurm --tasks 3");
  CHECK(job["job"] == "42");
  CHECK(job["runs"] == 12);
  CHECK(job["submitted"] == 12);
  CHECK(job["tasks"] == 3);
  const std::string arguments = cluster.text("bin/arguments");
  CHECK(arguments.rfind("--parsable\n--array=0,1,2\n--chdir=/", 0) == 0);

  const json collected = cluster.told("-o out --collect");
  CHECK(collected["done"] == 12);
  cluster.told(kSweep + " -o here");
  const std::string expected = without_costs(cluster.text("here/results.csv"));
  CHECK(without_costs(cluster.text("out/results.csv")) == expected);
  fs::remove(cluster.path("out/results.csv"));
  cluster.told(kSweep + " -o out --collect");
  CHECK(without_costs(cluster.text("out/results.csv")) == expected);
}

TEST_CASE("slurm: no matter how many tasks, a family is made by one and no run twice") {
  for (const std::string tasks : {"1", "4", "500"}) {
    const Cluster cluster;
    const json job = cluster.told(kSweep + " -o out --slurm --tasks " + tasks);
    CHECK(job["tasks"] == std::min(6, std::stoi(tasks)));
    int made = 0;
    for (const auto& entry : fs::directory_iterator(job["folder"].get<std::string>())) {
      if (entry.path().extension() != ".log") continue;
      const std::string log = read_file(entry.path());
      INFO(log);
      const std::size_t end = log.find(" runs made\n");  // "slice 1 of 3: 4 runs made"
      REQUIRE(end != std::string::npos);
      made += std::stoi(log.substr(log.rfind(' ', end - 1)));
    }
    CHECK(made == 12);
  }
}

TEST_CASE("slurm: names that a shell would take apart, options of one's own and threads reach the script") {
  const Cluster cluster;
  fs::create_directory(cluster.path("it's a $HOME"));
  const Outcome outcome = cluster.sweep(kSweep +
                                        " -o \"it's a \\$HOME/o u t\" --slurm --threads 3 --sbatch-options "
                                        "'--partition=long --comment=\"a b\"'");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.rfind("job 42: 12 of 12 runs in 6 tasks\n", 0) == 0);
  CHECK(outcome.out.find("  ramify sweep -o 'it'\\''s a $HOME/o u t' --collect gathers\n") !=
        std::string::npos);
  const fs::path jobs = cluster.path("it's a $HOME/o u t/slurm");
  const std::string script = read_file(fs::directory_iterator(jobs)->path() / "job.sh");
  CHECK(script.find("--cpus-per-task=3\n#SBATCH --partition=long --comment=\"a b\"\nexec ") !=
        std::string::npos);
  CHECK(cluster.sweep("-o \"it's a \\$HOME/o u t\" --collect").code == 0);
}

TEST_CASE("slurm: only what is missing is submitted again, to the tasks that it fell to") {
  const Cluster cluster;
  cluster.told(kSweep + " -o out --slurm --tasks 3");
  cluster.told("-o out --collect");
  std::istringstream rows(cluster.text("out/results.csv"));
  for (std::string row; std::getline(rows, row);) {  // seed 2 is the second task's
    if (row.find(",2,") == 16) fs::remove_all(cluster.path("out/runs/" + row.substr(0, 16)));
  }
  check_failure(
      cluster.sweep("-o out --collect --quiet"), 1,
      "2 of 12 runs are missing, of job 42's tasks 1 (`squeue --job 42` tells whether they run; logs: ");
  CHECK(cluster.text("out/results.csv").find(",2,3,") != std::string::npos);
  CHECK(cluster.text("out/results.csv").find(",missing,") != std::string::npos);

  const json again = cluster.told(kSweep + " -o out --slurm --tasks 3");
  CHECK(again["submitted"] == 2);
  CHECK(cluster.text("bin/arguments").find("--array=1\n") != std::string::npos);
  CHECK(cluster.told("-o out --collect")["done"] == 12);
  // Nothing is left to submit.
  fs::remove(cluster.bin() / "arguments");
  CHECK(cluster.told(kSweep + " -o out --slurm")["done"] == 12);
  CHECK_FALSE(fs::exists(cluster.bin() / "arguments"));
}

TEST_CASE("slurm: what is done in the folder meanwhile does not change a job that waits") {
  const Cluster cluster("#!/bin/sh\necho 7\n");
  const json job = cluster.told(kSweep + " -o out --slurm --tasks 2");
  check_failure(cluster.sweep("-o out --collect --quiet"), 1,
                "12 of 12 runs are missing, of job 7's tasks 0, 1 (`squeue --job 7` ");
  cluster.told("s4-fig6 --vary seed=90 --steps 3 -o out");
  const std::string script = "sh '" + job["folder"].get<std::string>() + "/job.sh'";
  // One is requeued and made twice at once.
  const Outcome tasks = run_shell("export SLURM_ARRAY_TASK_ID=0; " + script + " & " + script +
                                  " & SLURM_ARRAY_TASK_ID=1 " + script + " && wait");
  INFO(tasks.err);
  CHECK(tasks.code == 0);
  CHECK(cluster.told(kSweep + " -o out --collect")["done"] == 12);
  for (const auto& entry : fs::directory_iterator(cluster.path("out/runs"))) {
    CHECK(entry.path().filename().string().front() != '.');
  }
}

TEST_CASE("slurm: a run that fails there has its row and its line in the log") {
  const Cluster cluster;
  const std::string sweep = "xm12-fig22-sparse --vary pathplan.unreachable=error,warn --vary seed=1,2 -o out";
  const json job = cluster.told(sweep + " --slurm --tasks 1");
  check_failure(cluster.sweep("-o out --collect --quiet"), 1,
                "2 of 4 runs failed (out/results.csv says why)\n");
  const std::string log = read_file(job["folder"].get<std::string>() + "/task-0.log");
  CHECK(log.find("slice 0 of 1: 2 runs made\n") != std::string::npos);
  CHECK(log.find("ramify: 2 of 4 runs failed\n") != std::string::npos);
}

TEST_CASE("slurm: a task that is asked to end leaves no halves") {
  const Cluster cluster("#!/bin/sh\necho 7\n");
  const json job = cluster.told("p09-fig7-50 --vary seed=1:300:1 -o out --slurm --tasks 1");
  const Outcome outcome =
      run_shell("SLURM_ARRAY_TASK_ID=0 sh '" + job["folder"].get<std::string>() +
                "/job.sh' & for i in $(seq 1000); do ls '" + cluster.path("out/runs").string() +
                "' | grep -q . && break; sleep 0.01; done; kill $!; wait $!");
  CHECK(outcome.code == 130);
  CHECK(outcome.err == "ramify: interrupted; what is made is kept\n");
  for (const auto& entry : fs::directory_iterator(cluster.path("out/runs"))) {
    CHECK(fs::exists(entry.path() / "result.json"));
  }
}

TEST_CASE("slurm: a sweep here leaves alone what other machines have half-written") {
  const Cluster cluster;
  cluster.told("s4-fig6 --vary seed=1 --steps 3 -o out");
  const fs::path others = cluster.path("out/runs/.0123456789abcdef.elsewhere.1.tmp");
  const fs::path file = cluster.path("out/runs/.0123456789abcdef.failed.1.tmp");
  fs::create_directory(others);
  std::ofstream(file) << "half";
  cluster.told("s4-fig6 --vary seed=1 --steps 3 -o out");
  CHECK(fs::exists(others));
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("slurm: what it cannot do is one line") {
  const Cluster cluster(
      "#!/bin/sh\necho 'sbatch: error: invalid partition specified: x' >&2\n"
      "echo 'sbatch: error: Batch job submission failed' >&2\nexit 1\n");
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    INFO(arguments);
    check_failure(cluster.sweep(arguments), 2, message);
    CHECK_FALSE(fs::exists(cluster.path("out")));
  };
  refused(kSweep + " -o out --tasks 3", "--tasks: goes with --slurm\n");
  refused(kSweep + " -o out --sbatch-options=-v", "--sbatch-options: goes with --slurm\n");
  refused(kSweep + " -o out --collect --tasks 3", "--tasks: goes with --slurm\n");
  refused(kSweep + " -o out --slurm --collect", "--slurm, --collect: one of them");
  check_out_of_range(cluster.sweep(kSweep + " -o out --slurm --tasks 0"), "--tasks", "0", "1", "10000");
  CHECK_FALSE(fs::exists(cluster.path("out")));
  refused(kSweep + " -o out --slurm --sbatch-options 'a\nb'", "--sbatch-options: is more than a line\n");
  refused("-o out --slurm", "config is required\n");
  refused("s4-fig6 -o out --slurm", "--vary is required\n");
  refused("s4-fig6 -o out --collect", "--vary is required\n");
  refused("-o out --collect --seed 3", "--seed: goes with CONFIG\n");
  refused("-o out --collect", "--collect: out: no sweep is there\n");

  const Outcome failing = cluster.sweep(kSweep + " -o out --slurm");
  check_failure(failing, 1,
                "--slurm: sbatch: error: invalid partition specified: x; sbatch: error: Batch job submission "
                "failed (the job script is /");
  CHECK_FALSE(fs::exists(cluster.path("out/results.csv")));
  const Outcome none =
      run_program("sweep " + kSweep + " -o other --slurm", cluster.path("").string(), "PATH=/nowhere ");
  check_failure(none, 1, "--slurm: there is no sbatch in PATH (its job script is /");
}
