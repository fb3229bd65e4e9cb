        TRANS   PEG [18 40 3 90 90 0]
        TRANS   HOLE [25 36 4 90 90 0]
        OPEN    1
        MOVE    PEG
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        SEARCH  .07
        MOVE    HOLE
L1:     STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23              ;no resistance: this is the hole
        AOJ     L1
        OPEN    1
        CHANGE  [0 0 1] 2
        PARK
