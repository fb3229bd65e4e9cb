; search with a step of seven hundredths
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        SEARCH  7
L1:     MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L1
        SAVE    E1
        PARK
