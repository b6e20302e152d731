#pragma once

#include <string>
#include <vector>

#include "scene/option_reader.h"
#include "scene/scene.h"

namespace pounding {

/// Lines of doubt about options that are given and that nothing of the scene uses, one each, with
/// name, value and the feature they go with. An option at its default is none of them, nor is one
/// whose counterpart somebody switches off on purpose (`-contacts none`, `-fields_interval 0`). To
/// be asked after everything was read.
std::vector<std::string> idle_options(const OptionReader& options, const Scene& scene,
                                      const ListedNames& listed);

}  // namespace pounding
