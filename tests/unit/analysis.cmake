# What is made of recorded histories.
tread_add_test(NAME analysis_spectrum SOURCE analysis_spectrum.cc)
