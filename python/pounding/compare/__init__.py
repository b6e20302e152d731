"""Parts of run/compare."""
