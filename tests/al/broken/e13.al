; two holes in the plate
        TRANS   LEFT [22 36 4 90 90 0]
        TRANS   RIGHT [27 36 4 90 90 0]
        OPEN    .3
        MOVE    LEFT
        SEARCH  .07
L1:     MOVE    LEFT
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        SAVE    E1
        CHANGE  Z 1
        MOVE    RIGHT
        SEARCH  .07
L2:     MOVE    RIGHT
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        SAVE    E2
        CHANGE  Z 1
        MOVE    LEFT
        RESTORE E1 LEVEL
        MOVE    RIGHT
        RESTORE E2 LEVEL
        PARK
