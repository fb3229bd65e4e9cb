        TRANS   NEST [22 34 4 90 90 0]
        OPEN    .5
        MOVE    NEST
        SEARCH  .07
L1:     MOVE    NEST
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6     ;is this the hole?
        SKIP    23
        AOJ     L1
        SAVE    N
        CHANGE  Z 2
        MOVE    NEST
        RESTORE N
        WHERE
        PARK
