/// Feeds the readers with files that were sound before they were changed at random, in this
/// process:
///
///     fuzz_readers SECONDS [TARGET...]      every target by default; the seconds are for each
///     fuzz_readers --one TARGET FILE        reads one file and says what comes of it
///
/// Whatever a reader throws but UserError is a failure: its file is kept in the folder that is
/// printed, and the exit status is 1. A crash, or a file that takes longer than 20 s, ends the
/// program, and its file is the last one there. POUNDING_FUZZ_SEED (1 if it is not set) seeds the
/// changes.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

#include <slepcsys.h>

#include "common/error.h"
#include "fuzz/hdf5_mutator.h"
#include "fuzz/target.h"
#include "support/source_folder.h"

namespace pounding {

std::string source_folder() {
  return POUNDING_SOURCE_DIR;
}

namespace {

namespace fs = std::filesystem;
using fuzz::Random;
using fuzz::Target;
using Clock = std::chrono::steady_clock;

constexpr unsigned longest = 20;  ///< seconds that one file may take
constexpr int most_failures = 20;

struct Counts {
  long long accepted = 0;
  long long refused = 0;
  long long failed = 0;
};

/// Files that once failed, in the order of their names, behind the seeds.
std::vector<std::string> seeds_of(const Target& target) {
  std::vector<std::string> seeds = target.seeds;
  const fs::path found = fs::path(source_folder()) / "tests/fuzz/found" / target.name;
  std::vector<fs::path> files;
  if (fs::is_directory(found)) {
    files.assign(fs::directory_iterator(found), fs::directory_iterator());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

void write(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
}

/// Reads one file and notes what comes of it.
void feed(const Target& target, const std::string& path, Random& random, Counts& counts) {
  alarm(longest);
  std::string failure;
  try {
    target.read(path, random);
    ++counts.accepted;
  } catch (const UserError& error) {
    ++counts.refused;
    if (std::strchr(error.what(), '\n') != nullptr) {
      failure = std::string("more than one line: ") + error.what();
    }
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (...) {
    failure = "something that is no exception";
  }
  alarm(0);
  if (!failure.empty()) {
    const std::string kept = path + ".failed" + std::to_string(counts.failed++);
    fs::copy_file(path, kept, fs::copy_options::overwrite_existing);
    std::printf("%s: %s: %s\n", target.name.c_str(), kept.c_str(), failure.c_str());
  }
}

/// Feeds a target for a time, the seeds themselves first.
Counts fuzz_target(const Target& target, const std::string& folder, double seconds,
                   std::uint64_t seed) {
  const std::vector<std::string> seeds = seeds_of(target);
  const std::string path = folder + "/" + target.file;
  const auto start = Clock::now();
  Random random(seed);
  Counts counts;
  for (const std::string& content : seeds) {
    write(path, content);
    feed(target, path, random, counts);
  }
  while (std::chrono::duration<double>(Clock::now() - start).count() < seconds &&
         counts.failed < most_failures) {
    const bool through_hdf5 = target.is_hdf5 && random.chance(2);
    const std::string& base = random.one_of(seeds);
    write(path, through_hdf5 ? base : mutated(base, random.one_of(seeds), target.words, random));
    if (through_hdf5) {
      change_hdf5(path, random);
    }
    feed(target, path, random, counts);
  }
  std::printf(
      "%-12s %10lld files in %4.0f s: %9lld accepted, %9lld refused, %lld failed (seed %llu)\n",
      target.name.c_str(), counts.accepted + counts.refused + counts.failed,
      std::chrono::duration<double>(Clock::now() - start).count(), counts.accepted, counts.refused,
      counts.failed, static_cast<unsigned long long>(seed));
  std::fflush(stdout);
  return counts;
}

void read_one(const Target& target, const std::string& path) {
  Random random(1);
  try {
    target.read(path, random);
    std::puts("accepted");
  } catch (const UserError& error) {
    std::printf("refused: %s\n", error.what());
  }
}

int run(const std::vector<std::string>& words, const std::string& folder) {
  std::vector<Target> targets = fuzz::text_targets();
  for (Target& target : fuzz::state_targets(folder)) {
    targets.push_back(std::move(target));
  }
  const bool one = words.size() == 3 && words[0] == "--one";
  const char* const given = std::getenv("POUNDING_FUZZ_SEED");
  const std::uint64_t seed = given == nullptr ? 1 : std::strtoull(given, nullptr, 10);
  long long failed = 0;
  long long fed = 0;
  for (const Target& target : targets) {
    if (words.size() > 1 && std::find(words.begin() + 1, words.end(), target.name) == words.end()) {
      continue;
    }
    if (one) {
      read_one(target, words[2]);
      return 0;
    }
    const Counts counts = fuzz_target(target, folder, std::atof(words[0].c_str()), seed);
    failed += counts.failed;
    fed += counts.accepted + counts.refused;
  }
  return failed == 0 && fed > 0 ? 0 : 1;
}

}  // namespace
}  // namespace pounding

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  if (arguments.empty()) {
    std::puts("fuzz_readers SECONDS [TARGET...] | --one TARGET FILE");
    return 1;
  }
  int none = 1;
  SlepcInitialize(&none, &words, nullptr, nullptr);
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("pounding-fuzz-" + std::to_string(getpid())))
          .string();
  std::filesystem::create_directories(folder);
  std::printf("files are in %s\n", folder.c_str());
  std::fflush(stdout);
  const int status = pounding::run(arguments, folder);
  if (status == 0) {
    std::filesystem::remove_all(folder);
  }
  SlepcFinalize();
  return status;
}
