// SPDX-License-Identifier: LGPL-2.1-or-later
// Time left until a falling measure reaches its limit.
#include <tread/output/progress.h>

#include "check.h"

#include <cmath>

using namespace tread;

TREAD_TEST(output_progress)(tests::Check &check, const tests::Arguments &)
{
  // A measure that falls e times in 2 s is at its limit after 2 s ln(1e5) = 23 s; with ripples upon it when
  // its peaks are.
  TimeLeft steady(1e-5);
  check.that("nothing is said of a single measure", !steady.seconds());
  for (double t = 0.; t <= 10.; t += 0.25)
    steady.add(t, std::exp(-0.5 * t));
  check.relative("steady fall: seconds left", steady.seconds().value_or(0.), 2. * std::log(1e5) - 10., 1e-9);

  TimeLeft rippled(1e-5);
  for (double t = 0.; t <= 10.; t += 0.1)
    rippled.add(t, std::exp(-0.5 * t) * (1.5 + std::sin(20. * t)));
  check.relative("fall with ripples: seconds left", rippled.seconds().value_or(0.),
                 2. * std::log(2.5e5) - 10., 0.05);

  // Slow at last: the mean from the beginning would promise too much.
  TimeLeft slow(1e-5);
  for (double t = 0.; t <= 40.; t += 0.25)
    slow.add(t, t < 5. ? std::exp(-t) : std::exp(-5. - 0.05 * (t - 5.)));
  check.relative("slow at last: seconds left", slow.seconds().value_or(0.), (std::log(1e5) - 5.) / 0.05 - 35.,
                 0.1);

  // What is laid on anew counts from there on.
  for (double t = 40.; t <= 44.; t += 0.25)
    slow.add(t, std::exp(-(t - 40.)));
  check.relative("laid on anew: seconds left", slow.seconds().value_or(0.), std::log(1e5) - 4., 1e-9);

  TimeLeft still(1e-5);
  for (double t = 0.; t <= 10.; t += 0.5)
    still.add(t, 0.1);
  check.that("nothing is said of what does not fall", !still.seconds());
  TimeLeft done(1e-2);
  for (double t = 0.; t <= 10.; t += 0.5)
    done.add(t, std::exp(-t));
  check.absolute("at its limit nothing is left, s", done.seconds().value_or(-1.), 0., 0.);
}
