// SPDX-License-Identifier: LGPL-2.1-or-later
// Keywords of Abaqus and LS-DYNA that are no mesh: those that would change the answer are refused, those that
// cannot are passed over and named.
#ifndef tread_mesh_mesh_file_foreign_h
#define tread_mesh_mesh_file_foreign_h

#include <algorithm>
#include <string>
#include <vector>

namespace tread::mesh_foreign
{
  /// Keywords that are refused, and what to do instead.
  struct Refused
  {
    std::vector<std::string> keywords;
    const char              *instead;
  };

  inline constexpr const char *join_nodes =
    "pieces hang together by common nodes only; mesh them as one, with faces that meet, and remove it";
  inline constexpr const char *write_in_place =
    "write all nodes and elements with their numbers and places in x, y and z, in one file";
  inline constexpr const char *no_state =
    "the rail begins without stress, at rest and at one temperature; remove it if that is meant";
  inline constexpr const char *no_parts = "the rail is of hexahedra of one steel alone, without springs, "
                                          "masses, bars, shells or rigid parts; remove "
                                          "it if the answer does not need it";

  inline const std::vector<Refused> &refused_of_abaqus()
  {
    static const std::vector<Refused> list{
      {{"INCLUDE", "SYSTEM", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "TRANSFORM", "IMPERFECTION",
        "IMPORT", "IMPORT NSET", "IMPORT ELSET", "MANIFEST", "SYMMETRIC MODEL GENERATION", "PARAMETER",
        "SYMMETRIC RESULTS TRANSFER", "NODAL THICKNESS"},
       write_in_place},
      {{"TIE", "EQUATION", "MPC", "COUPLING", "KINEMATIC", "DISTRIBUTING", "KINEMATIC COUPLING",
        "DISTRIBUTING COUPLING", "SHELL TO SOLID COUPLING", "EMBEDDED ELEMENT", "FASTENER",
        "FASTENER PROPERTY", "BOND", "CYCLIC SYMMETRY MODEL", "TIED CONTACT", "COHESIVE BEHAVIOR",
        "COHESIVE SECTION", "ADJUST", "SUBMODEL"},
       join_nodes},
      {{"INITIAL CONDITIONS", "MAP SOLUTION", "GEOSTATIC", "PRE-TENSION SECTION", "CONTACT INTERFERENCE",
        "MODEL CHANGE", "ELEMENT PROGRESSIVE ACTIVATION"},
       no_state},
      {{"RIGID BODY",
        "DISPLAY BODY",
        "MASS",
        "ROTARY INERTIA",
        "NONSTRUCTURAL MASS",
        "SPRING",
        "DASHPOT",
        "JOINT",
        "CONNECTOR SECTION",
        "BEAM SECTION",
        "BEAM GENERAL SECTION",
        "FRAME SECTION",
        "GASKET SECTION",
        "SHELL SECTION",
        "SHELL GENERAL SECTION",
        "MEMBRANE SECTION",
        "REBAR",
        "REBAR LAYER",
        "INERTIA RELIEF",
        "USER ELEMENT",
        "UEL PROPERTY",
        "MATRIX INPUT",
        "MATRIX ASSEMBLE",
        "SUBSTRUCTURE PROPERTY",
        "SUBSTRUCTURE GENERATE",
        "EULERIAN SECTION",
        "ENRICHMENT",
        "FLUID CAVITY"},
       no_parts},
    };
    return list;
  }

  /// Keywords of Abaqus that a mesh may have and that cannot change the answer, before the first step. Below
  /// *MATERIAL and *SURFACE INTERACTION others follow.
  inline const std::vector<std::string> &passed_over_of_abaqus()
  {
    static const std::vector<std::string> list{
      "MATERIAL",
      "SOLID SECTION",
      "SECTION CONTROLS",
      "ORIENTATION",
      "DISTRIBUTION",
      "DISTRIBUTION TABLE",
      "HOURGLASS STIFFNESS",
      "AMPLITUDE",
      "PHYSICAL CONSTANTS",
      "BOUNDARY",
      "SURFACE INTERACTION",
      "CONTACT",
      "CONTACT PAIR",
      "CONTACT INCLUSIONS",
      "CONTACT EXCLUSIONS",
      "CONTACT PROPERTY ASSIGNMENT",
      "CONTACT INITIALIZATION DATA",
      "CONTACT CONTROLS",
      "CONTACT FORMULATION",
      "CONTACT CONTROLS ASSIGNMENT",
      "CONTACT STABILIZATION",
      "SURFACE PROPERTY ASSIGNMENT",
      "PREPRINT",
      "RESTART",
      "FILTER",
      "TIME POINTS",
      "BULK VISCOSITY",
      "RELEASE",
      "INTEGRATED OUTPUT SECTION",
      "SECTION PRINT",
      "WAVEFRONT MINIMIZATION",
      "NODE PRINT",
      "EL PRINT",
      "OUTPUT",
      "NODE OUTPUT",
      "ELEMENT OUTPUT",
      "NODE FILE",
      "EL FILE",
      "FILE FORMAT",
      "MONITOR",
      "SPECTRUM",
      "DAMPING CONTROLS",
      "CORRELATION",
      "STEP",
    };
    return list;
  }

  /// By the beginnings of keywords; the first one that fits counts.
  inline const std::vector<Refused> &refused_of_ls_dyna()
  {
    static const std::vector<Refused> list{
      {{"INCLUDE", "NODE_", "DEFINE_TRANSFORM", "PERTURBATION", "PARAMETER", "CASE", "COMPONENT"},
       write_in_place},
      {{"CONSTRAINED", "CONTACT_TIED", "CONTACT_SPOTWELD", "CONTACT_GUIDED", "DEFINE_CONNECTION",
        "BOUNDARY_CYCLIC", "BOUNDARY_MCOL", "DEFINE_HEX_SPOTWELD"},
       join_nodes},
      {{"INITIAL", "CHANGE_STATUS"}, no_state},
      {{"ELEMENT_", "PART_", "RIGIDWALL", "AIRBAG", "DEFORMABLE_TO_RIGID", "RIGID_DEFORMABLE"}, no_parts},
    };
    return list;
  }

  inline const std::vector<std::string> &passed_over_of_ls_dyna()
  {
    static const std::vector<std::string> list{
      "CONTROL",     "DATABASE", "MAT",          "SECTION", "EOS",       "HOURGLASS",
      "DEFINE",      "LOAD",     "BOUNDARY",     "DAMPING", "SET_PART",  "SET_SOLID",
      "SET_SHELL",   "SET_BEAM", "SET_DISCRETE", "CONTACT", "INTERFACE", "SENSOR",
      "TERMINATION", "COMMENT",  "INTEGRATION",  "UNIT"};
    return list;
  }

  inline bool begins_with(const std::string &text, const std::string &begin)
  {
    return text.compare(0, begin.size(), begin) == 0;
  }

  /// What to do in place of a keyword; null: it is not refused. @param whole compare whole keywords, and not
  /// their beginnings
  inline const char *instead_of(const std::string          &keyword,
                                const std::vector<Refused> &list,
                                const bool                  whole)
  {
    for (const Refused &refused : list)
      for (const std::string &name : refused.keywords)
        if (whole ? keyword == name : begins_with(keyword, name))
          return refused.instead;
    return nullptr;
  }

  inline constexpr const char *unknown = "it is not known here and may change the answer; remove it if the "
                                         "cells and the names of their faces do not "
                                         "need it";
} // namespace tread::mesh_foreign

#endif
