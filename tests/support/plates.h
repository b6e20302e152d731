#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "solvers/sparse_rows.h"

namespace pounding::interactions {

/// Two plates of unit sides that meet, `nodes` x `nodes` points against bilinear facets of another
/// plate of `facets` x `facets`, `heavier` times as heavy.
struct Plates {
  SparseRows delassus;
  std::vector<double> rate;

  Plates(int nodes, int facets, double heavier, unsigned seed) {
    const int corners = facets + 1;
    std::vector<std::map<int, double>> rows(nodes * nodes);
    std::vector<std::vector<int>> rows_of(corners * corners);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> velocity(-1, 1);
    std::vector<double> primary(corners * corners);
    for (double& v : primary) v = velocity(random);
    for (int i = 0; i < nodes * nodes; ++i) {
      const int row = i / nodes;
      const double x = static_cast<double>(row) / (nodes - 1) * facets;
      const double y = static_cast<double>(i - row * nodes) / (nodes - 1) * facets;
      const int a = std::min(static_cast<int>(x), facets - 1);
      const int b = std::min(static_cast<int>(y), facets - 1);
      rate.push_back(-velocity(random));
      for (int corner = 0; corner < 4; ++corner) {
        const double s = corner / 2 == 0 ? 1 - (x - a) : x - a;
        const double t = corner % 2 == 0 ? 1 - (y - b) : y - b;
        const int number = (a + corner / 2) * corners + b + corner % 2;
        if (s * t == 0) continue;
        rows[i][number] = s * t;
        rows_of[number].push_back(i);
        rate.back() += s * t * primary[number];
      }
    }
    const double mass = 1.0 / (nodes * nodes);
    const double primary_mass = heavier / (corners * corners);
    for (int i = 0; i < nodes * nodes; ++i) {
      std::map<int, double> entries{{i, 1 / mass}};
      for (const auto& [number, weight] : rows[i]) {
        for (const int j : rows_of[number]) {
          entries[j] += weight / primary_mass * rows[j].at(number);
        }
      }
      for (const auto& [column, value] : entries) delassus.add(column, value);
      delassus.end_row();
    }
  }
  std::size_t rows() const { return rate.size(); }
};

/// 0, 1, 2, ...
inline std::vector<std::size_t> first_places(std::size_t count) {
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

}  // namespace pounding::interactions
