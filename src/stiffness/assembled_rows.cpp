#include "stiffness/assembled_rows.h"

#include <algorithm>
#include <cstddef>

namespace pounding::stiffness {

void AssembledRows::Pattern::add(std::span<const LocalIndex> slots) {
  for (const LocalIndex row : slots) {
    if (row < 0 || row >= owned_) continue;
    auto& columns = columns_[row];
    for (const LocalIndex column : slots) {
      if (column >= 0) columns.push_back(column);
    }
    // Neighbours repeat each other: keep the list short while it grows.
    if (columns.size() > 512) {
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    }
  }
}

AssembledRows::AssembledRows(Pattern&& pattern) : owned_dofs_(pattern.owned_) {
  for (LocalIndex row = 0; row < owned_dofs_; ++row) {
    auto& columns = pattern.columns_[row];
    std::sort(columns.begin(), columns.end());
    const auto end = std::unique(columns.begin(), columns.end());
    const auto ghosts = std::lower_bound(columns.begin(), end, owned_dofs_);
    const auto append = [row](Part& part, auto first, auto last, LocalIndex shift) {
      if (first == last) return;
      part.rows.push_back(row);
      for (; first != last; ++first) part.columns.push_back(*first - shift);
      part.start.push_back(part.columns.size());
    };
    append(owned_part_, columns.begin(), ghosts, 0);
    append(ghost_part_, ghosts, end, owned_dofs_);
    columns = {};
  }
  owned_part_.values.assign(owned_part_.columns.size(), 0.0);
  ghost_part_.values.assign(ghost_part_.columns.size(), 0.0);
}

void AssembledRows::add(std::span<const LocalIndex> slots, std::span<const double> matrix) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i] < 0 || slots[i] >= owned_dofs_) continue;
    for (std::size_t j = 0; j < slots.size(); ++j) {
      const double value = matrix[i * slots.size() + j];
      if (slots[j] >= owned_dofs_) {
        add_entry(ghost_part_, slots[i], slots[j] - owned_dofs_, value);
      } else if (slots[j] >= 0) {
        add_entry(owned_part_, slots[i], slots[j], value);
      }
    }
  }
}

void AssembledRows::add_entry(Part& part, LocalIndex row, LocalIndex column, double value) {
  const std::size_t r =
      std::lower_bound(part.rows.begin(), part.rows.end(), row) - part.rows.begin();
  const auto begin = part.columns.begin() + static_cast<std::ptrdiff_t>(part.start[r]);
  const auto end = part.columns.begin() + static_cast<std::ptrdiff_t>(part.start[r + 1]);
  part.values[std::lower_bound(begin, end, column) - part.columns.begin()] += value;
}

void AssembledRows::add_product(const Part& part, const double* w, double* q) {
  for (std::size_t r = 0; r < part.rows.size(); ++r) {
    const LocalIndex* const column = part.columns.data();
    const double* const value = part.values.data();
    const std::size_t end = part.start[r + 1];
    double even = 0;
    double odd = 0;
    std::size_t k = part.start[r];
    for (; k + 1 < end; k += 2) {
      even += value[k] * w[column[k]];
      odd += value[k + 1] * w[column[k + 1]];
    }
    if (k < end) even += value[k] * w[column[k]];
    q[part.rows[r]] += even + odd;
  }
}

}  // namespace pounding::stiffness
