# Mortar coupling, impulses and friction: closed forms, conservation, Coulomb's law.
tread_add_test(NAME contact_coulomb_solver SOURCE contact_coulomb_solver.cc)
tread_add_test(NAME contact_patch SOURCE contact_patch.cc RANKS 1 3)
