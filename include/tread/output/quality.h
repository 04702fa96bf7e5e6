// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_output_quality_h
#define tread_output_quality_h

#include <tread/dynamics/explicit_dynamics.h>
#include <tread/output/summary.h>

#include <optional>
#include <string>
#include <vector>

namespace tread
{
  /// What a user judges a run by.
  struct Quality
  {
    EnergyLedger          energy;
    std::optional<double> slip_chatter;             ///< none: nothing was averaged
    double                contact_unconverged = 0.; ///< share of the steps

    // Beyond these a warning is given.

    /// Energy residual over what was dissipated. Frictional power and creepage are compared within one to two
    /// per cent, and energy that is not accounted for may be missing from friction.
    static constexpr double large_residual = 0.02;
    /// Contact loss over what was dissipated, for the same reason.
    static constexpr double large_contact_loss = 0.02;
    /// Over the internal energy: residual and contact loss below it are nothing to warn of, however little is
    /// dissipated.
    static constexpr double negligible = 1e-3;
    /// The same for damping: what strikes rings, and where nothing slips little else takes energy.
    static constexpr double negligible_damping = 1e-2;
    /// Damping of the cells over friction and plasticity. It belongs to the numerics: at a tenth it takes
    /// part in the answer. The dampers of a track are not counted.
    static constexpr double large_damping = 0.1;
    /// Hourglass energy over the internal energy: the customary 5 % for one-point cells (Flanagan &
    /// Belytschko 1981 control the modes, they do not resolve them).
    static constexpr double large_hourglass = 0.05;
    /// Slip chatter. The curvature of slip between two cells leaves a few per cent, chatter some ten.
    static constexpr double large_chatter = 0.1;
    /// Share of steps whose contact did not converge. Rare ones are corrected by the steps after them.
    static constexpr double large_unconverged = 0.01;

    void add_to(Summary &summary) const;

    /// A few lines for the screen.
    std::string lines() const;

    /// One line for each measure that is large: what it says and what to do.
    std::vector<std::string> warnings() const;
  };
} // namespace tread

#endif
