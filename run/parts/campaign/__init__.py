"""The paper's cases one by one: what they are, how they are run, what is found; run/campaign."""
