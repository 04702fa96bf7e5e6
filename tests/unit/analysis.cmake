# What is made of recorded histories.
tread_add_test(NAME analysis_spectrum SOURCE analysis_spectrum.cc)
tread_add_test(NAME analysis_rail_stress SOURCE analysis_rail_stress.cc RANKS 1 3)
tread_add_test(NAME analysis_chatter SOURCE analysis_chatter.cc)
tread_add_test(NAME output_quality SOURCE output_quality.cc)

# What a run is resumed from.
tread_add_test(NAME checkpoint_members SOURCE checkpoint_members.cc RANKS 1 2)
