// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/analysis/archard_map_wear.h>
#include <tread/analysis/archard_wear.h>
#include <tread/analysis/wear_law.h>
#include <tread/analysis/work_wear.h>

namespace tread
{
  namespace
  {
    template <typename Law>
    WearLawEntry entry()
    {
      return {Law::name, Law::description, &Law::declare, &Law::make};
    }

    WearLawEntry no_wear()
    {
      return {"none", "surfaces lose nothing", [](Section &) {},
              [](const dealii::ParameterHandler &) {
                return std::shared_ptr<const WearLaw>();
              }};
    }
  } // namespace


  const std::vector<WearLawEntry> &wear_laws()
  {
    static const std::vector<WearLawEntry> laws{no_wear(), entry<ArchardWear>(), entry<ArchardMapWear>(),
                                                entry<WorkWear>()};
    return laws;
  }


  void declare_wear_laws(Section &section)
  {
    for (const WearLawEntry &law : wear_laws())
      law.declare(section);
  }
} // namespace tread
