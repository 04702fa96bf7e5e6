# Yielding: material point, cells, and structures with known answers.
tread_add_test(NAME material_plastic SOURCE material_plastic.cc)
tread_add_test(NAME solid_plastic SOURCE solid_plastic.cc)
