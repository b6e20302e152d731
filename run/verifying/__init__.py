"""Parts of run/verification."""
