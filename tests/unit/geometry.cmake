tread_add_test(NAME geometry_profiles SOURCE geometry_profiles.cc)
tread_add_test(NAME bodies_shapes SOURCE bodies_shapes.cc)
tread_add_test(NAME mesh_whole_rail SOURCE mesh_whole_rail.cc)
tread_add_test(NAME geometry_surfaces SOURCE geometry_surfaces.cc)
