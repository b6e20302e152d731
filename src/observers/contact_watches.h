#pragma once

#include "observers/observed_run.h"

namespace pounding {

/// Impacts of a run, from the impulses of its steps: `impacts.csv` and `contact_points.csv`.
OutputKind impact_output();

/// Pairs are found once, in the initial geometry. This keeps how far each node has moved along the
/// facet that it faces, whether they touch or not, on the ranks that have displacements of the
/// interface. It reads displacements and changes nothing; nothing allocates after construction. Of
/// a run with contacts. Collective.
OutputKind slide_output();

/// Contact ratio of every structure that has compression-only springs, at the lines of the energy
/// ledger.
OutputKind uplift_output();

/// Smallest gap at t_n and mean force over the interval of each contact, for the history; and how
/// far the pairs have closed at the samples. On the root of the contacts.
OutputKind contact_history_output();

}  // namespace pounding
