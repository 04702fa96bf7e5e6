# Yielding: material point, cells, and structures with known answers.
tread_add_test(NAME material_plastic SOURCE material_plastic.cc)
tread_add_test(NAME solid_plastic SOURCE solid_plastic.cc)
tread_add_test(NAME plastic_sphere SOURCE plastic_sphere.cc)
tread_add_test(NAME plastic_taylor SOURCE plastic_taylor.cc)
tread_add_test(NAME plastic_hertz SOURCE plastic_hertz.cc)
