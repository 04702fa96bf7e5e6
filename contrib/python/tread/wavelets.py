# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where along a record which frequencies occur: zero-phase band-pass, continuous wavelet transform, its maxima.

The transform is that of Torrence and Compo (1998), Bulletin of the American Meteorological Society 79, pages 61 to 78, with
Morlet's wavelet of six oscillations. It is evaluated in the frequency domain (their equations 4 and 6), where the wavelet of
every scale is known exactly. (Debian 12's PyWavelets samples a table of the wavelet instead: doc/dev/records/tried.md.)
"""

from __future__ import annotations

import numpy as np

OSCILLATIONS = 6.0
# Scale times frequency at which the power of a sine is largest (their table 1).
SCALE_TIMES_FREQUENCY = (OSCILLATIONS + np.sqrt(2 + OSCILLATIONS**2)) / (4 * np.pi)
# White noise of variance 1 has the power 1 on average and exceeds this one in 5 % of the places (their equation 18: half of
# the 95 % point of chi-square with two degrees of freedom).
NOISE_95 = -np.log(0.05)


def evenly_spaced(time: np.ndarray, *columns: np.ndarray) -> tuple[np.ndarray, ...]:
    """The columns on equally spaced times, as many as there are: (times, column, ...)."""
    even = np.linspace(time[0], time[-1], len(time))
    return even, *(np.interp(even, time, column) for column in columns)


def band_pass(values: np.ndarray, step: float, low: float, high: float, order: int = 4) -> np.ndarray:
    """A Butterworth band-pass of this order for each edge, forwards and backwards: no phase is shifted. @param step s
    @param low, high edges, Hz, where half of the amplitude is left"""
    n = len(values)
    # A straight line does not pass and would kink at the ends, at which the rest is mirrored.
    line = np.polynomial.Polynomial.fit(np.arange(n), values, 1)
    values = np.asarray(values, float) - line(np.arange(n))
    before, after = values[:0:-1], values[-2::-1]
    spectrum = np.fft.rfft(np.concatenate([before, values, after]))
    frequency = np.fft.rfftfreq(3 * n - 2, step)
    with np.errstate(divide="ignore"):
        spectrum /= (1 + (low / frequency) ** (2 * order)) * (1 + (frequency / high) ** (2 * order))
    return np.fft.irfft(spectrum, 3 * n - 2)[n - 1:2 * n - 1]


class Scalogram:
    """The wavelet power of a record over time and frequency.

    frequency  (frequencies,) Hz, equally spaced in octaves
    power      (frequencies, times) over the record's variance: 1 is what white noise of that variance has on average
    amplitude  (frequencies, times) of the sine that has this power, in the record's unit
    reliable   (frequencies, times) False in the cone of influence, where the ends of the record reach
    edge       (times,) Hz: the cone lies below this frequency
    """

    def __init__(self, values: np.ndarray, step: float, low: float, high: float, per_octave: int = 24):
        values = np.asarray(values, float) - np.mean(values)
        n, self.step = len(values), step
        if not 0 < low < high <= 0.5 / step:
            raise ValueError(f"frequencies from {low} to {high} Hz in a record that ends at {0.5 / step} Hz")
        self.frequency = low * 2 ** (np.arange(int(per_octave * np.log2(high / low)) + 1) / per_octave)
        scale = SCALE_TIMES_FREQUENCY / self.frequency[:, None]
        self.variance = values.var()
        # Zeros behind it keep one end from reaching the other.
        m = 2 ** int(np.ceil(np.log2(2 * n)))
        omega = 2 * np.pi * np.fft.fftfreq(m, step)
        wavelet = np.where(omega > 0, np.pi**-0.25 * np.exp(-0.5 * (scale * omega - OSCILLATIONS) ** 2), 0)
        self.coefficient = np.fft.ifft(np.fft.fft(values, m) * np.sqrt(2 * np.pi * scale / step) * wavelet)[:, :n]
        size = abs(self.coefficient)
        self.power = size**2 / (self.variance or 1)
        of_unit_sine = 0.5 * np.sqrt(2 * np.pi * scale / step) * np.pi**-0.25 * np.exp(
            -0.5 * (2 * np.pi * SCALE_TIMES_FREQUENCY - OSCILLATIONS) ** 2)
        self.amplitude = size / of_unit_sine
        # A spike at an end has lost the factor e^2 of power after sqrt(2) scales.
        from_end = step * np.minimum(np.arange(n), np.arange(n)[::-1])
        with np.errstate(divide="ignore"):
            self.edge = np.sqrt(2) * SCALE_TIMES_FREQUENCY / from_end
        self.reliable = self.frequency[:, None] > self.edge

    def global_spectrum(self) -> np.ndarray:
        """Mean power over the reliable times of each frequency; nan where there are none."""
        count = self.reliable.sum(axis=1)
        with np.errstate(invalid="ignore"):
            return np.where(count > 0, (self.power * self.reliable).sum(axis=1) / count, np.nan)

    def maxima(self, most: int = 5, least: float = NOISE_95) -> list[tuple[float, int, float, float]]:
        """[(frequency in Hz, index of the time, power, amplitude)] of the largest maxima of power over time and frequency, one
        for each spot: two that lie within what one wavelet covers are one."""
        power = np.where(self.reliable, self.power, 0)
        inner = power[1:-1, 1:-1]
        around = [power[1 + i:power.shape[0] - 1 + i, 1 + j:power.shape[1] - 1 + j] for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
        rows, columns = np.nonzero((inner >= np.max(around, axis=0)) & (inner > least))
        found = []
        for k, n in sorted(zip(rows + 1, columns + 1), key=lambda place: -power[place]):
            f = self.frequency[k]
            # The wavelet's power falls by e over one scale to each side, and over a sixth of the frequency.
            if any(abs(np.log(f / other[0])) < 2 / OSCILLATIONS
                   and abs(n - other[1]) * self.step < 2 * SCALE_TIMES_FREQUENCY / min(f, other[0]) for other in found):
                continue
            # The vertex of a parabola through three logarithms.
            a, b, c = np.log(np.maximum(self.power[k - 1:k + 2, n], 1e-300))
            shift = 0.5 * (a - c) / (a - 2 * b + c) if a - 2 * b + c < 0 else 0.0
            found.append((f * (self.frequency[1] / self.frequency[0]) ** shift, n, self.power[k, n], self.amplitude[k, n]))
            if len(found) == most:
                break
        return found
