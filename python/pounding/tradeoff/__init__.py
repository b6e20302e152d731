"""Parts of run/tradeoff."""
