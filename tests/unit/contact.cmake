# Mortar coupling, impulses and friction: closed forms, conservation, Coulomb's law.
tread_add_test(NAME contact_coulomb_solver SOURCE contact_coulomb_solver.cc)
tread_add_test(NAME contact_patch SOURCE contact_patch.cc RANKS 1 3)
tread_add_test(NAME contact_momentum SOURCE contact_momentum.cc RANKS 1 3)
tread_add_test(NAME contact_bars SOURCE contact_bars.cc)
tread_add_test(NAME contact_hertz SOURCE contact_hertz.cc)
tread_add_test(NAME contact_cattaneo SOURCE contact_cattaneo.cc)
tread_add_test(NAME contact_incline SOURCE contact_incline.cc)
tread_add_test(NAME contact_return SOURCE contact_return.cc)
