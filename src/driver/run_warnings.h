#pragma once

#include <string>
#include <vector>

#include "driver/model.h"

namespace pounding {

/// Doubts about end time and time step beside the motion and the records: nothing that could
/// move, a record that ends before the run does, a step longer than a sample. One line each.
std::vector<std::string> run_warnings(const Scene& scene, const Model& model);

/// The line about a step longer than what lies between two samples of `of`, both in s; none where
/// it is not.
void add_long_step(const std::string& of, double sample, double step,
                   std::vector<std::string>& warnings);

}  // namespace pounding
