; go down to the hole (forces copied from the paper)
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        SEARCH  .07
L1:     MOVE    T1
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0.6
        SKIPE   23
        AOJ     L1
        STOP    [0 0 −60]
        CHANGE  [0 0 -1] 0.6
        SKIPN   23
        AOJ     L1
        SAVE    E1
        OPEN    1
