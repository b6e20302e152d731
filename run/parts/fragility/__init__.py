"""Parts of run/fragility: the study file, its members, their runs, what is told of them."""
