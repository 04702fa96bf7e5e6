# Hexahedra and the explicit time integration. 3 ranks wherever cells of
# several ranks share nodes or hanging nodes.
tread_add_test(NAME solid_patch SOURCE solid_patch.cc RANKS 1 3)
tread_add_test(NAME solid_rotation SOURCE solid_rotation.cc)
tread_add_test(NAME solid_hourglass SOURCE solid_hourglass.cc)
tread_add_test(NAME solid_lanes SOURCE solid_lanes.cc)
tread_add_test(NAME dynamics_waves SOURCE dynamics_waves.cc)
tread_add_test(NAME dynamics_conservation SOURCE dynamics_conservation.cc RANKS 1 3)
tread_add_test(NAME dynamics_stability SOURCE dynamics_stability.cc)
tread_add_test(NAME dynamics_energy SOURCE dynamics_energy.cc RANKS 1 3)
tread_add_test(NAME dynamics_levels SOURCE dynamics_levels.cc)
tread_add_test(NAME dynamics_ranks SOURCE dynamics_ranks.cc RANKS 1 2 3)
