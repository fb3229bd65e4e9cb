        TRANS   HOLE [25 36 4 90 90 0]
        OPEN    .5
        SEARCH  .07
L1:     MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0,6
        SKIPE   23
        AOJ     L1
        CHANGE  [0 0 1] 2
        PARK
