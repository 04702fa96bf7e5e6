// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_contact_patch_h
#define tread_analysis_contact_patch_h

#include <tread/base/archive.h>
#include <tread/contact/contact_records.h>

#include <map>
#include <vector>

namespace tread
{
  /// Tractions on the wheel and slip of its surface over the rail's at one rail node, SI units.
  struct PatchNode
  {
    Vector3 position; ///< x from the patch centre in rolling direction, y, z
    double  area, pressure, shear[2], slip[2];
    bool    adhesion;

    double shear_size() const;
    double slip_speed() const;
  };

  /// Measures of a contact patch, SI units.
  struct PatchMeasures
  {
    double area = 0., max_pressure = 0., adhesion_share = 0., max_shear = 0., max_slip = 0.,
           frictional_power = 0.;
    /// Half of the extent of the nodes in contact and their cells.
    double semi_axis_x = 0., semi_axis_y = 0.;
    /// Semi-axes of the Hertzian ellipse with the same second moments of pressure, a^2 = 5 int p x^2 / int p.
    /// They resolve less than a cell.
    double pressure_semi_axis_x = 0., pressure_semi_axis_y = 0.;
    /// Resultants on the wheel, N, and the moment of the shear about the normal through the origin, N m.
    double normal_force = 0., longitudinal_force = 0., lateral_force = 0., spin_moment = 0.;
    double x_middle = 0., y_middle = 0.;           ///< of the extent
    double x_of_pressure = 0., y_of_pressure = 0.; ///< where the resultant of the pressure acts
  };

  /// The patch at one instant. @param centre_x position of the wheel's centre, m; @param time_step s.
  std::vector<PatchNode> patch_nodes(const std::vector<ContactNodeState> &states,
                                     const double                         centre_x,
                                     const double                         time_step);

  PatchMeasures measure(const std::vector<PatchNode> &patch);

  /// Average, over a number of steps, of the quantities at each rail node and of the measures of the patch.
  class PatchAverage
  {
  public:
    void add(const std::vector<ContactNodeState> &states, const double centre_x, const double time_step);

    /// Mean tractions over all steps; mean slip over the steps in contact; x relative to the mean centre. A
    /// node is in adhesion if it adhered in most of its steps in contact.
    std::vector<PatchNode> nodes() const;

    /// Means of the measures of each step.
    PatchMeasures measures() const;

    /// Deviation of the micro-slip in single steps from the averaged one: RMS over all nodes and steps in
    /// contact, over the largest averaged slip. A node passes through the patch by one cell in the meantime,
    /// over which slip changes even without chatter. Each node is therefore compared with the straight line
    /// over its position in the patch that best fits its own slip; curvature between two cells remains.
    double slip_chatter() const;

    unsigned int n_steps() const
    {
      return steps;
    }

    /// Store or restore the sums.
    void serialize(Archive &archive);

  private:
    struct Sum
    {
      PatchNode    values{};
      unsigned int in_contact = 0, adhesive = 0;
      /// Sums over position in the patch x (m) and slip s (m/s): x, x x, s x by direction, s s.
      double x = 0., xx = 0., sx[2] = {0., 0.}, ss = 0.;
    };
    std::map<unsigned int, Sum> sums;
    PatchMeasures               measure_sums;
    double                      centre_sum = 0.;
    unsigned int                steps      = 0;
  };
} // namespace tread

#endif
