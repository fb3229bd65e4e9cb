; come back to the hole that was found
        OPEN    1
        MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SAVE    E1
        CHANGE  [0 0 1] 2
        MOVE    Q1
        RESTORE El LEVEL
        CLOSE   .1
        PARK
