"""Parts of run/sweep."""
