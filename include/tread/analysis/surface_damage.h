// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_analysis_surface_damage_h
#define tread_analysis_surface_damage_h

#include <tread/analysis/wear_law.h>
#include <tread/base/archive.h>
#include <tread/contact/contact.h>
#include <tread/reference/surface_heat.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace tread
{
  struct SurfaceDamageParameters
  {
    double                         interval; ///< between looks at pressure and temperature, s
    std::shared_ptr<const WearLaw> wear;     ///< null: none
    /// sqrt(conductivity density heat capacity) of slave and masters, J/(m^2 K sqrt(s)).
    double slave_effusivity, master_effusivity;
    double master_share; ///< of the heat of friction that flows into the masters
  };

  /// What rolling has done to a place of a surface, in the reference configuration, SI units.
  struct SurfacePlace
  {
    double along, y;        ///< x of a rail, m; angle about the axle of a wheel, rad
    double area;            ///< of the surface that the node stands for, m^2
    double friction_work;   ///< per area, J/m^2
    double slip_distance;   ///< of the other surface over it, m
    double max_pressure;    ///< Pa
    double max_shear;       ///< Pa
    double passages;        ///< number of times that it came into contact
    double max_temperature; ///< largest rise by friction, K
    double wear_depth;      ///< m
  };

  /// The largest rise of temperature of these places, K.
  double max_temperature(const std::vector<SurfacePlace> &places);

  /// What friction does to both surfaces, by their nodes: work, slip and wear are summed over all steps, so
  /// that the work over the surface is that of the ledger. A pair's work counts for its slave node, and for
  /// the masters' nodes under it in the shares in which its impulse goes to them. Pressure and shear stress
  /// are nodal impulses over the nodes' areas.
  ///
  /// Heat flows straight into the depth (@see SurfaceHeat), in fixed shares. Both surfaces meet with the same
  /// history of heat but for the slip, so that shares in the ratio of the effusivities give both one
  /// temperature.
  class SurfaceDamage
  {
  public:
    SurfaceDamage(Contact &contact, unsigned int slave_body, const SurfaceDamageParameters &parameters);

    /// Have friction depend on the temperature: a factor of its coefficient at a rise of it (K), as it was at
    /// the last look.
    void vary_friction(std::function<double(double)> factor);

    /// To be called after each step. Collective.
    void add_step(double time_step);

    /// New wheels roll over the rail, which has cooled down.
    void begin_passage();

    /// Of each surface node, by its number, on all ranks; `along` is x. Collective.
    std::vector<SurfacePlace> by_node();

    /// The nodes of a body that were ever loaded, of all ranks, in the order of place. Collective.
    /// @param along the first coordinate at a reference position
    std::vector<SurfacePlace> places(unsigned int body, const std::function<double(const Vector3 &)> &along);

    /// Store or restore the state. Collective.
    void serialize(Archive &archive);

  private:
    /// Of a surface node. Sums are this rank's shares of them; the rest is known on the node's own rank.
    struct Node
    {
      double        work = 0., slip = 0., wear = 0.; ///< J, m^3, m^3
      double        heat     = 0.;                   ///< since the last look, J
      double        pressure = 0., shear = 0.;       ///< largest, Pa
      double        passages     = 0.;
      std::uint64_t loaded_until = 0;  ///< look; 0: never
      double        temperature  = 0.; ///< largest rise, K
    };
    struct Hot
    {
      reference::SurfaceHeat::Memory memory{};
      std::uint64_t                  until = 0;  ///< look until which the memory is kept
      double                         rise  = 0.; ///< then, K
    };
    struct Stored
    {
      unsigned int node;
      Node         state;
      bool         is_hot;
      Hot          hot;
    };

    void take(const PairRecord &record);
    void look(double time_step);
    void note_contact(Node &node) const;
    void heat_up();
    /// Tell all ranks how hot the slave nodes are, if friction is to know. Collective.
    void   share_rises();
    double share_of(unsigned int body) const
    {
      return body == slave_body ? 1. - parameters.master_share : parameters.master_share;
    }
    double effusivity_of(unsigned int body) const
    {
      return body == slave_body ? parameters.slave_effusivity : parameters.master_effusivity;
    }
    /// Nodes with sums and the rest complete, on all ranks. Collective.
    std::vector<Node> complete();

    Contact                                &contact;
    unsigned int                            slave_body;
    SurfaceDamageParameters                 parameters;
    int                                     rank;
    std::vector<double>                     area;  ///< by surface node, m^2
    std::vector<Node>                       nodes; ///< by surface node
    std::map<unsigned int, Hot>             hot;   ///< of this rank's own
    std::unique_ptr<reference::SurfaceHeat> heat;  ///< made when the time step is known
    std::uint64_t                           steps_since_look = 0, looks = 0;
    std::vector<double>                     rises; ///< by surface node at the last look, K; none: nobody asks
  };
} // namespace tread

#endif
