// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/surface_damage.h>
#include <tread/base/gathered.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tread
{
  namespace
  {
    /// Integrals of the bilinear shape functions over the faces around each node, in the reference
    /// configuration.
    std::vector<double> nodal_areas(const ContactSurfaces &surfaces)
    {
      const double        near = 0.5 - 0.5 / std::sqrt(3.), far = 1. - near;
      std::vector<double> area(surfaces.nodes.size(), 0.);
      for (const ContactSurfaces::Face &face : surfaces.faces)
        {
          std::array<Vector3, 4> p;
          for (unsigned int a = 0; a < 4; ++a)
            p[a] = surfaces.nodes[face.nodes[a]].reference;
          for (const double s : {near, far})
            for (const double t : {near, far})
              {
                const Vector3 along  = (1. - t) * (p[1] - p[0]) + t * (p[2] - p[3]),
                              across = (1. - s) * (p[3] - p[0]) + s * (p[2] - p[1]);
                const double weight  = 0.25 * norm(cross(along, across));
                const double shape[] = {(1. - s) * (1. - t), s * (1. - t), s * t, (1. - s) * t};
                for (unsigned int a = 0; a < 4; ++a)
                  area[face.nodes[a]] += weight * shape[a];
              }
        }
      return area;
    }

    /// Looks. What comes back within as long as ten cells take to pass has come into contact once.
    constexpr std::uint64_t in_contact = 40;
    /// Looks after which no place is in the patch any more in which it was heated.
    constexpr std::uint64_t behind_patch = 400;
  } // namespace


  double max_temperature(const std::vector<SurfacePlace> &places)
  {
    double highest = 0.;
    for (const SurfacePlace &place : places)
      highest = std::max(highest, place.max_temperature);
    return highest;
  }


  SurfaceDamage::SurfaceDamage(Contact                       &contact,
                               const unsigned int             slave_body,
                               const SurfaceDamageParameters &parameters)
    : contact(contact)
    , slave_body(slave_body)
    , parameters(parameters)
    , rank(dealii::Utilities::MPI::this_mpi_process(contact.surfaces.comm))
    , area(nodal_areas(contact.surfaces))
    , nodes(contact.surfaces.nodes.size())
  {
    contact.record_pairs([this](const PairRecord &record) { take(record); });
  }


  void SurfaceDamage::take(const PairRecord &record)
  {
    const PairRecord::Totals &t = record.totals;
    const double              wear =
      parameters.wear ? parameters.wear->volume({t.friction, t.sliding, t.distance, t.duration, record.area})
                                   : 0.;
    const auto add = [&](Node &node, const double share) {
      node.work += share * t.friction;
      node.slip += share * record.area * t.distance;
      node.wear += share * wear;
      node.heat += share * t.friction;
    };
    add(nodes[record.slave], 1.);
    for (const PairRecord::Share &master : record.masters)
      add(nodes[master.node], master.share);
  }


  void SurfaceDamage::add_step(const double time_step)
  {
    contact.add_step_to_record(time_step);
    if (++steps_since_look * time_step >= parameters.interval)
      look(time_step);
  }


  void SurfaceDamage::look(const double time_step)
  {
    contact.hand_over_record();
    contact.complete_normals();
    constexpr double least = 1e4; // Pa; round-off of the coupling leaves less beside the patch
    ++looks;
    contact.visit_impulses([&](const unsigned int i, const double normal, const double tangential) {
      Node        &node     = nodes[i];
      const double per_area = 1. / (area[i] * time_step);
      node.pressure         = std::max(node.pressure, per_area * normal);
      node.shear            = std::max(node.shear, per_area * tangential);
      if (per_area * normal > least)
        note_contact(node);
    });
    // All looks are as many steps apart.
    if (!heat)
      heat = std::make_unique<reference::SurfaceHeat>(steps_since_look * time_step);
    steps_since_look = 0;
    heat_up();
  }


  void SurfaceDamage::note_contact(Node &node) const
  {
    // At the sides of the patch the wheel's nodes are now under a pair and now not.
    node.passages += node.loaded_until == 0 || looks - node.loaded_until > in_contact;
    node.loaded_until = looks;
  }


  void SurfaceDamage::heat_up()
  {
    struct Flow
    {
      unsigned int node;
      double       heat;
    };
    std::vector<Flow> of_rank;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].heat != 0.)
        {
          of_rank.push_back({i, nodes[i].heat});
          nodes[i].heat = 0.;
        }
    std::map<unsigned int, double> flows;
    for (const Flow &flow : gathered(of_rank, contact.surfaces.comm))
      if (contact.surfaces.nodes[flow.node].owner == rank)
        flows[flow.node] += flow.heat;
    for (const auto &[i, energy] : flows)
      {
        note_contact(nodes[i]); // between two looks
        Hot               &here = hot[i];
        const unsigned int body = contact.surfaces.nodes[i].body;
        if (here.until + 1 < looks)
          heat->rest(here.memory, (looks - 1 - here.until) * heat->interval());
        here.until           = looks;
        const double flux    = share_of(body) * energy / (area[i] * heat->interval());
        here.rise            = heat->flow(here.memory, flux) / effusivity_of(body);
        nodes[i].temperature = std::max(nodes[i].temperature, here.rise);
      }
    share_rises();
  }


  void SurfaceDamage::vary_friction(std::function<double(double)> factor)
  {
    rises.assign(nodes.size(), 0.);
    contact.prescribed.vary_friction_with_node(
      [this, factor = std::move(factor)](const unsigned int node) { return factor(rises[node]); });
  }


  void SurfaceDamage::share_rises()
  {
    if (rises.empty())
      return;
    struct Rise
    {
      unsigned int node;
      double       kelvin;
    };
    std::vector<Rise> of_rank;
    for (const auto &[i, here] : hot)
      if (contact.surfaces.nodes[i].body == slave_body && looks < here.until + behind_patch)
        {
          double rise = here.rise;
          if (here.until < looks) // it adheres now, and cools
            {
              reference::SurfaceHeat::Memory memory = here.memory;
              heat->rest(memory, (looks - 1 - here.until) * heat->interval());
              rise = heat->flow(memory, 0.) / effusivity_of(slave_body);
            }
          of_rank.push_back({i, rise});
        }
    std::fill(rises.begin(), rises.end(), 0.);
    for (const Rise &rise : gathered(of_rank, contact.surfaces.comm))
      rises[rise.node] = rise.kelvin;
    contact.renew_friction();
  }


  std::vector<SurfaceDamage::Node> SurfaceDamage::complete()
  {
    contact.hand_over_record();
    std::vector<double> numbers;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const Node &node = nodes[i];
        const bool  own  = contact.surfaces.nodes[i].owner == rank;
        for (const double number : {node.work, node.slip, node.wear})
          numbers.push_back(number);
        for (const double number : {node.pressure, node.shear, node.passages, node.temperature})
          numbers.push_back(own ? number : 0.);
      }
    dealii::Utilities::MPI::sum(numbers, contact.surfaces.comm, numbers);
    std::vector<Node> all(nodes.size());
    auto              number = numbers.begin();
    for (Node &node : all)
      for (double *of_node : {&node.work, &node.slip, &node.wear, &node.pressure, &node.shear, &node.passages,
                              &node.temperature})
        *of_node = *number++;
    return all;
  }


  std::vector<SurfacePlace> SurfaceDamage::by_node()
  {
    std::vector<SurfacePlace> list;
    const std::vector<Node>   all = complete();
    for (unsigned int i = 0; i < all.size(); ++i)
      {
        const Node    &node     = all[i];
        const Vector3 &at       = contact.surfaces.nodes[i].reference;
        const double   per_area = area[i] > 0. ? 1. / area[i] : 0.; // of a node whose faces are all left out
        // What touched between the last two looks did so once.
        const double passages = std::max(node.passages, node.work != 0. ? 1. : 0.);
        list.push_back({at[0], at[1], area[i], per_area * node.work, per_area * node.slip, node.pressure,
                        node.shear, passages, node.temperature, per_area * node.wear});
      }
    return list;
  }


  std::vector<SurfacePlace> SurfaceDamage::places(const unsigned int                            body,
                                                  const std::function<double(const Vector3 &)> &along)
  {
    std::vector<SurfacePlace> list = by_node(), loaded;
    for (unsigned int i = 0; i < list.size(); ++i)
      if (const ContactSurfaces::Node &at = contact.surfaces.nodes[i];
          at.body == body && (list[i].passages > 0. || list[i].friction_work != 0.))
        {
          loaded.push_back(list[i]);
          loaded.back().along = along(at.reference);
        }
    std::sort(loaded.begin(), loaded.end(), [](const SurfacePlace &a, const SurfacePlace &b) {
      return a.along != b.along ? a.along < b.along : a.y < b.y;
    });
    return loaded;
  }


  void SurfaceDamage::begin_passage()
  {
    contact.hand_over_record();
    hot.clear();
    std::fill(rises.begin(), rises.end(), 0.);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        nodes[i].heat         = 0.;
        nodes[i].loaded_until = 0;
        if (contact.surfaces.nodes[i].body != slave_body)
          nodes[i] = Node();
      }
  }


  void SurfaceDamage::serialize(Archive &archive)
  {
    std::vector<Stored> of_rank;
    if (!archive.restores())
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (nodes[i].work != 0. || nodes[i].heat != 0. || nodes[i].passages > 0.)
          {
            const auto found = hot.find(i);
            of_rank.push_back({i, nodes[i], found != hot.end(), found != hot.end() ? found->second : Hot()});
          }
    // The sums go on where the first rank has them; the rest is the node's own rank's.
    for (const Stored &stored : archive.records(of_rank))
      {
        if (stored.node >= nodes.size())
          throw OtherStoredLayout();
        Node &node = nodes[stored.node];
        if (rank == 0)
          {
            node.work += stored.state.work;
            node.slip += stored.state.slip;
            node.wear += stored.state.wear;
            node.heat += stored.state.heat;
          }
        if (contact.surfaces.nodes[stored.node].owner == rank)
          {
            node.pressure     = std::max(node.pressure, stored.state.pressure);
            node.shear        = std::max(node.shear, stored.state.shear);
            node.loaded_until = std::max(node.loaded_until, stored.state.loaded_until);
            node.passages     = std::max(node.passages, stored.state.passages);
            node.temperature  = std::max(node.temperature, stored.state.temperature);
            if (stored.is_hot)
              hot[stored.node] = stored.hot;
          }
      }
    double interval = heat ? heat->interval() : 0.;
    archive.same(steps_since_look, looks, interval);
    if (archive.restores() && interval > 0.)
      {
        heat = std::make_unique<reference::SurfaceHeat>(interval);
        share_rises();
      }
  }
} // namespace tread
