; show the screwdriver, and put it back
        OPEN    1.6
        MOVE    D
        CENTER  .5
        CLOSE   .9 1.1
        LOAD    15
        CHANGE  [1 0 0] 3
        CHANGE  [0 0 1] 3
        WHERE
        MOVE    DUP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] .8
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 3
        PARK
