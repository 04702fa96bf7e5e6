# The reference library: closed forms and the half-space solver.
tread_add_test(NAME reference_hertz SOURCE reference_hertz.cc LIBRARIES tread_reference)
tread_add_test(NAME reference_kalker SOURCE reference_kalker.cc LIBRARIES tread_reference)
tread_add_test(NAME reference_half_space SOURCE reference_half_space.cc LIBRARIES tread_reference)
target_compile_definitions(reference_half_space PRIVATE TREAD_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data")
tread_add_test(NAME reference_track SOURCE reference_track.cc LIBRARIES tread_reference)
tread_add_test(NAME reference_rolling SOURCE reference_rolling.cc LIBRARIES tread_reference)
tread_add_test(NAME reference_gap SOURCE reference_gap.cc LIBRARIES tread_reference)
