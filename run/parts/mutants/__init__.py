"""Parts of run/mutants: the patches, and their trial."""
