; bring the screwdriver to the pump and back
        OPEN    .6
        MOVE    D
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        LOAD    15
        MOVE    H0
        WHERE
        MOVE    DUP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] .8
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2
        PARK
