// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_recorders_passage_growth_h
#define tread_recorders_passage_growth_h

#include <tread/dynamics/state.h>
#include <tread/scene/sections/ratcheting.h>
#include <tread/solid/solid.h>

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace tread
{
  /// What a passage after the other leaves in the steel, and the jump over passages that are not rolled.
  ///
  /// The state after a passage is the history of the steel, with the net plastic strain as a logarithm, and
  /// the places of nodes. Its change in a passage is extrapolated with the slope that it had since the jump
  /// before (projective integration, Gear & Kevrekidis, SIAM J. Sci. Comput. 24, 2003, with two rates as
  /// Adams and Bashforth have them), less what fades in the passages that are rolled after a jump. Where the
  /// steel flows, places say what its plastic strain becomes; its stresses change only as far as they did so
  /// alike in the last two passages: residual stresses settle within passages, and their noise, extrapolated
  /// by itself, would be what the next passages have to take away.
  class PassageGrowth
  {
  public:
    /// @param judged by cell of the mesh: where strains are compared. @param moved by node: those of the rail
    /// @param uniform tells of a place of the reference configuration whether it is in the middle of the
    /// path: what is left there, the mean along each line, is left to the whole rail. Null: each place keeps
    /// its own.
    PassageGrowth(const RatchetingSection                             &section,
                  const Mesh                                          &mesh,
                  const Solid                                         &solid,
                  State                                               &state,
                  const std::vector<char>                             &judged,
                  const std::vector<char>                             &moved,
                  const std::function<bool(const dealii::Point<3> &)> &uniform);

    /// Take up the state after a passage. Collective.
    void note(const double number);

    /// Largest net plastic strain of the judged cells, where it is, and what the last passage added.
    double net_strain() const
    {
      return strain;
    }
    dealii::Point<3> place() const ///< centre in the reference configuration, m
    {
      return {place_of_strain[0], place_of_strain[1], place_of_strain[2]};
    }
    double rate() const ///< largest of the judged cells
    {
      return largest_rate;
    }
    bool has_failed() const
    {
      return section.strain_at_failure > 0. && strain >= section.strain_at_failure;
    }

    /// Steel that has shaken down changes by no more than the noise of its passages, which is not
    /// extrapolated.
    bool has_shaken_down() const
    {
      return largest_rate < 1e-8;
    }

    /// How many passages may be left out now. @param remaining those that are still to come. Collective.
    unsigned int passages_to_skip(const unsigned int remaining) const;

    /// Go on to what there will be after n more passages, and put it into the state. @param n may be 0
    void begin_next(const unsigned int n);

    /// How far all jumps together have put the net plastic strain off, about: half the difference between the
    /// rate that was expected behind each and the one that was found, times its passages, summed with its
    /// sign in each cell, and the largest of them.
    double       error_of_strain() const;
    unsigned int n_jumps() const
    {
      return jumps;
    }
    unsigned int n_skipped() const
    {
      return skipped;
    }

    /// Places are in the state's fields. Collective.
    void serialize(Archive &archive);

  private:
    /// A state after a passage, or a difference of two.
    struct Residue
    {
      PlasticHistory steel; ///< with logarithms
      NodalField     places;

      Residue operator-(const Residue &other) const;
      void    add(const double factor, const Residue &other);
      void    scale(const double factor);
    };

    Residue now() const;
    /// The steel with its stresses. @see PlasticCells::with_stresses()
    PlasticHistory stresses_of(const Residue &residue) const;
    /// Stresses and backstresses n passages on, after those of the last three passages.
    PlasticHistory stresses_in(const unsigned int    n,
                               const PlasticHistory &now,
                               const PlasticHistory &before,
                               const PlasticHistory &before_that) const;
    void           make_uniform(Residue &residue) const;
    void           skip(const unsigned int n);
    /// Root of the sum of squares, and the largest, of the net plastic strain over the judged cells.
    double norm(const Residue &residue) const;
    double largest(const Residue &residue) const;
    /// Sum of the products of the net plastic strains; of one residue the square of the norm.
    double product(const Residue &a, const Residue &b) const;

    /// What the change per passage is made of: i passages from now it is steady + i slope + factor^i fading.
    /// The slope is that since the last jump, from the second on its mean with the one that the last jump
    /// had, so that older ones count half, a quarter ... as much: a jump with too large a slope leaves a rate
    /// that makes the next slope too small.
    struct Course
    {
      Residue steady, slope, fading;
      double  factor;
    };
    Course                  course() const;
    static constexpr double slowest_fading = 0.7; ///< slower fading is a matter of the slope
    /// With names for the fields of the state that keep their places in checkpoints.
    std::array<std::pair<const char *, Residue *>, 7> residues();
    void                                              keep_places();

    const RatchetingSection                            &section;
    const Mesh                                         &mesh;
    const Solid                                        &solid;
    State                                              &state;
    std::vector<char>                                   judged, moved;
    const std::function<bool(const dealii::Point<3> &)> uniform;

    Residue      last;                        ///< state after the last passage, or after the jump behind it
    Residue      change;                      ///< of the last passage
    Residue      variation, variation_before; ///< of the change in the last two passages
    Residue      steady_at_jump;              ///< part of the change that did not fade, at the last jump
    Residue      slope_at_jump;               ///< of that part, from one passage to the next
    Residue      deviation;                   ///< by all jumps, of the state
    double       number = 0., number_at_jump = 0.;
    double       strain = 0., largest_rate = 0.;
    double       place_of_strain[3] = {0., 0., 0.};
    unsigned int rolled             = 0; ///< since the last jump
    unsigned int last_jump = 0, jumps = 0, skipped = 0;
  };
} // namespace tread

#endif
