// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/registry.h>
#include <tread/solid/element.h>
#include <tread/solid/fully_integrated.h>
#include <tread/solid/one_point.h>

namespace tread
{
  namespace
  {
    template <typename E>
    ElementEntry entry()
    {
      return {E::name,
              E::description,
              E::can_yield,
              E::has_bulk_viscosity,
              E::has_hourglass_modes,
              E::largest_poisson_ratio,
              [](const SolidParameters &parameters) -> std::shared_ptr<const Element> {
                return std::make_shared<E>(parameters);
              }};
    }
  } // namespace


  const std::vector<ElementEntry> &elements()
  {
    static const std::vector<ElementEntry> list{
      entry<OnePoint>(),
      entry<FullyIntegrated>(),
    };
    return list;
  }


  const ElementEntry &element_named(const std::string &name)
  {
    return entry_named(elements(), name, "element");
  }
} // namespace tread
