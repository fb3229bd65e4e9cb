        TRANS   SLOT [23 33 4 90 90 0]
        OPEN    .5
        MOVE    SLOT
        SEARCH  .07
L1:     MOVE    SLOT
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SAVE    H
        SKIPE   23              ;it went in
        AOJ     L1
        CHANGE  Z 2
        MOVE    SLOT
        RESTORE H LEVEL
        PARK
