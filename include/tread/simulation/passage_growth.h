// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_simulation_passage_growth_h
#define tread_simulation_passage_growth_h

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
  /// Adams and Bashforth have them); what a jump disturbs must fade in the passages that are rolled after it.
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

    /// Sum over all jumps of how far the net plastic strain is off at most: half the difference between the
    /// rate that was expected behind the jump and the one that was found, times its passages.
    double error_of_strain() const
    {
      return error;
    }
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
    void    make_uniform(Residue &residue) const;
    void    skip(const unsigned int n);
    /// Root of the sum of squares, and the largest, of the net plastic strain over the judged cells.
    double norm(const Residue &residue) const;
    double largest(const Residue &residue) const;
    /// Change of the rate per passage since the last jump; from the second on its mean with what the last
    /// jump had, so that older slopes count half, a quarter ... as much: a jump with too large a slope leaves
    /// a rate that makes the next slope too small.
    Residue slope() const;
    /// With names for the fields of the state that keep their places in checkpoints.
    std::array<std::pair<const char *, Residue *>, 5> residues();
    void                                              keep_places();

    const RatchetingSection                            &section;
    const Mesh                                         &mesh;
    const Solid                                        &solid;
    State                                              &state;
    std::vector<char>                                   judged, moved;
    const std::function<bool(const dealii::Point<3> &)> uniform;

    Residue      last;                  ///< state after the last passage, or after the jump behind it
    Residue      change, change_before; ///< of the last passage and of the one before
    Residue      change_at_jump;        ///< of the last passage before the last jump
    Residue      expected;              ///< slope that the last jump had
    double       number = 0., number_at_jump = 0.;
    double       strain = 0., largest_rate = 0., error = 0.;
    double       place_of_strain[3] = {0., 0., 0.};
    unsigned int rolled             = 0; ///< since the last jump
    unsigned int last_jump = 0, jumps = 0, skipped = 0;
  };
} // namespace tread

#endif
