#pragma once

namespace pounding {

/// Whether a maximum extends to the free vibration that follows the last sample.
enum class AfterRecord { free_vibration, ignored };

}  // namespace pounding
