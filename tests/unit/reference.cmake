# The reference library: closed forms and the half-space solver.
tread_add_test(NAME reference_hertz SOURCE reference_hertz.cc LIBRARIES tread_reference)
tread_add_test(NAME reference_kalker SOURCE reference_kalker.cc LIBRARIES tread_reference)
