        TRANS   SLOT [25 34 4 90 90 0]
        OPEN    .5
        MOVE    SLOT
AGAIN:  SEARCH  .07
        MOVE    SLOT
        STOP    [0 0 -45]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     AGAIN
        SAVE    D1
        CHANGE  [0 0 1] 2
        MOVE    SLOT
        RESTORE D1 LEVEL
        WHERE
        PARK
