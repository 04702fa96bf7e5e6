tread_add_test(NAME geometry_profiles SOURCE geometry_profiles.cc)
tread_add_test(NAME bodies_shapes SOURCE bodies_shapes.cc)
