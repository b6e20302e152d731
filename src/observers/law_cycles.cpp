#include "observers/law_cycles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "common/error.h"
#include "laws/hysteretic_law.h"
#include "observers/observed_run.h"
#include "scene/law_kinds.h"

namespace pounding {
namespace {

const ResultFile law_table{"laws.csv", "the laws of the scene through cycles (-law_cycles)",
                           "law,elongation,force,stored_J,lost_J"};

/// Laws of all regions, named structure:group:part.
std::vector<OwnLaw> laws_of(const Scene& scene) {
  std::vector<OwnLaw> laws;
  for (const Structure& structure : scene.structures) {
    for (const Region& region : structure.regions) {
      for (OwnLaw& own : own_laws(region)) {
        own.name = structure.name + ":" + region.group + ":" + own.name;
        laws.push_back(std::move(own));
      }
    }
  }
  return laws;
}

/// Rows of one law; its steps are a hundredth of the first corner, or of the amplitude's hundredth.
void write_loops(const OwnLaw& named, const std::vector<double>& amplitudes, CsvFile& file) {
  const interactions::HystereticLaw law(named.law);
  std::vector<double> memory(law.memory_size(), 0.0);
  const auto first = [](const Skeleton& skeleton, const Skeleton& other) {
    return (skeleton.breaks.empty() ? other : skeleton).breaks.front().elongation;
  };
  const double plus = first(named.law.positive, named.law.negative);
  const double minus = first(named.law.negative, named.law.positive);
  double at = 0;
  const auto write = [&] {
    file.row(named.name, {at, law.force(memory), law.stored(memory), law.lost(memory)});
  };
  const auto go = [&](double end) {
    constexpr int steps_of_first = 100;
    const double smallest = std::min(plus, minus) / steps_of_first;
    const int steps = static_cast<int>(std::ceil(std::abs(end - at) / smallest));
    const double begin = at;
    for (int i = 1; i <= steps; ++i) {
      at = begin + (end - begin) * i / steps;
      law.advance(at, memory);
      write();
    }
  };
  write();
  for (const double amplitude : amplitudes) {
    for (int cycle = 0; cycle < 2; ++cycle) {
      go(amplitude * plus);
      go(-amplitude * minus);
    }
    go(0);
  }
}

}  // namespace

OutputKind law_loops_output() {
  return {{law_table}};
}

void write_law_loops(MPI_Comm comm, const Scene& scene) {
  on_rank0(comm, [&] {
    constexpr double most = 1000;  // of steps, and of numbers read
    refuse_if(std::ranges::any_of(scene.law_cycles, [](double x) { return x > most; }),
              "option -law_cycles: an amplitude above 1000 times the first corner");
    const std::vector<OwnLaw> laws = laws_of(scene);
    refuse_if(laws.empty(),
              "option -law_cycles: nothing in the scene yields by a law in one dimension; see "
              "-<structure>_<group>_skeleton");
    create_output(scene.output);
    ResultTable file(scene, law_table);
    for (const OwnLaw& law : laws) write_loops(law, scene.law_cycles, file);
    file.close();
    std::printf("laws: %zu in %s/%s\n", laws.size(), scene.output.c_str(), law_table.name.c_str());
  });
}

}  // namespace pounding
