"""A ground motion in closed form that shakes like an earthquake: forty sines between 0.3 and 33 Hz, the
envelope of a rise, a plateau and a decay, and no random number. The golden ratio spreads the phases."""
import numpy

STEP, SAMPLES, PEAK = 0.005, 4001, 0.45 * 9.81


def acceleration():
    """Samples [m/s2] every STEP seconds, the largest of them PEAK."""
    t = numpy.arange(SAMPLES) * STEP
    lines = numpy.arange(1, 41)
    frequencies = 0.3 * (33 / 0.3) ** ((lines - 1) / 39)
    phases = 2 * numpy.pi * ((lines * (1 + 5**0.5) / 2) % 1)
    envelope = numpy.where(t < 2, t / 2, numpy.exp(-numpy.maximum(t - 8, 0) / 3))
    sines = numpy.sin(2 * numpy.pi * numpy.outer(t, frequencies) + phases)
    motion = envelope * (sines / (1 + frequencies / 10)).sum(1)
    return PEAK * motion / abs(motion).max()
