"""Models of other programs as scenes: a reader per format, the neutral model that they fill, and its one writer."""
