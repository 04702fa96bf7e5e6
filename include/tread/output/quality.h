// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_quality_h
#define tread_output_quality_h

#include <tread/dynamics/explicit_dynamics.h>
#include <tread/output/columns.h>
#include <tread/output/summary.h>

#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// A warning is given beyond these values.
  struct QualityLimits
  {
    /// Energy residual over the dissipated energy. Frictional power and creepage are compared within one to
    /// two per cent, and energy that is not accounted for may be missing from friction.
    double residual = 0.02;
    /// Contact loss over the dissipated energy, for the same reason.
    double contact_loss = 0.02;
    /// Damping of the cells over friction and plasticity. This damping is numerical: it takes up to 15 % in
    /// good runs whose traction is low, and 25 % move pressure and traction by 0.1 %. The dampers of a track
    /// are not counted.
    double damping = 0.2;
    /// Hourglass energy over the internal energy, which one-point cells control, but do not resolve (Flanagan
    /// & Belytschko 1981): 3 to 6 % in good runs, 17 % where the pressure is 22 % off.
    double hourglass = 0.08;
    /// Slip chatter. The curvature of slip between two cells contributes a few per cent, chatter about ten.
    double chatter = 0.1;
    /// Share of steps whose contact did not converge. Rare ones are corrected by the steps after them.
    double unconverged = 0.01;
  };

  /// The measures by which a user judges a run.
  struct Quality
  {
    EnergyLedger          energy;
    std::optional<double> slip_chatter;             ///< none: nothing was averaged
    double                contact_unconverged = 0.; ///< share of the steps
    QualityLimits         limits;

    /// Share of the internal energy below which residual and contact loss cause no warning, however little is
    /// dissipated.
    static constexpr double negligible = 1e-3;
    /// The same for damping: impacts excite vibrations, and where nothing slips little else dissipates
    /// energy.
    static constexpr double negligible_damping = 1e-2;

    void add_to(Summary &summary) const;

    /// A few lines for the screen.
    std::string lines() const;

    /// One line for each measure that is too large: what it means and what to do.
    std::vector<std::string> warnings() const;
  };

  /// The measures by their keys in summary.json.
  const Columns<Quality> &quality_columns();
} // namespace tread

#endif
