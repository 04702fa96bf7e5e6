# Rails of cells on discrete supports against beams.
tread_add_test(NAME track_statics SOURCE track_statics.cc)
tread_add_test(NAME track_receptance SOURCE track_receptance.cc PARTS bar 54E1 60E1)
tread_add_test(NAME track_ranks SOURCE track_ranks.cc RANKS 1 3)
tread_add_test(NAME track_ends SOURCE track_ends.cc RANKS 1 3)
tread_add_test(NAME track_moving_load SOURCE track_moving_load.cc)
